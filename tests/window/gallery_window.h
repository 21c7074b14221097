#pragma once

#include <memory>
#include <string>
#include <vector>

#include "presenter.h"

// A window that shows a picture, for others to draw over.
class GalleryWindow {
public:
    GalleryWindow(int width, int height, bool modern);
    ~GalleryWindow();
    GalleryWindow(const GalleryWindow&) = delete;
    GalleryWindow& operator=(const GalleryWindow&) = delete;

    bool open() const { return window_ && !bytes_.empty(); }
    void show_picture();               // as if it was rendered just now
    std::vector<uint8_t> read() const; // RGBA, top row first
    int width() const { return width_; }
    int height() const { return height_; }

private:
    int width_, height_;
    bool modern_;
    GLFWwindow* window_ = nullptr;
    std::unique_ptr<host::Presenter> presenter_;
    std::vector<float> radiance_;
    std::vector<uint8_t> bytes_;
    int picture_width_ = 0, picture_height_ = 0;
};
