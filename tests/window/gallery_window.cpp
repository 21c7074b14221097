#include "gallery_window.h"

#include <algorithm>

#include <stb/stb_image.h>

namespace {

constexpr float night = 0.62f; // the picture is of a lit hall

void hint_version(bool modern) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, modern ? 3 : 2);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, modern ? 3 : 1);
    if (modern) glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
}

} // namespace

GalleryWindow::GalleryWindow(int width, int height, bool modern)
    : width_(width), height_(height), modern_(modern) {
    if (!glfwInit()) return;
    hint_version(modern);
    window_ = glfwCreateWindow(width, height, "Gallery", nullptr, nullptr);
    if (!window_) return;
    glfwMakeContextCurrent(window_);
    glfwGetFramebufferSize(window_, &width_, &height_);
    presenter_ = std::make_unique<host::Presenter>(modern);
    int channels = 0;
    uint8_t* pixels = stbi_load(PICTURE, &picture_width_, &picture_height_, &channels, 4);
    if (!pixels) return;
    bytes_.assign(pixels, pixels + size_t{4} * picture_width_ * picture_height_);
    stbi_image_free(pixels);
    for (uint8_t& byte : bytes_) byte = static_cast<uint8_t>(night * byte);
    for (const uint8_t byte : bytes_) radiance_.push_back(static_cast<float>(byte) / 255.0f);
}

GalleryWindow::~GalleryWindow() {
    presenter_.reset();
    if (window_) glfwDestroyWindow(window_);
    glfwTerminate();
}

void GalleryWindow::show_picture() {
    const void* pixels = modern_ ? static_cast<const void*>(radiance_.data()) : bytes_.data();
    presenter_->show(pixels, static_cast<uint32_t>(picture_width_),
                     static_cast<uint32_t>(picture_height_), width_, height_, 1.0f, false);
}

std::vector<uint8_t> GalleryWindow::read() const {
    const size_t row = size_t{4} * static_cast<size_t>(width_);
    std::vector<uint8_t> upside_down(row * static_cast<size_t>(height_)), pixels;
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, upside_down.data());
    for (size_t y = static_cast<size_t>(height_); y-- > 0;)
        pixels.insert(pixels.end(), upside_down.begin() + static_cast<ptrdiff_t>(y * row),
                      upside_down.begin() + static_cast<ptrdiff_t>((y + 1) * row));
    for (size_t i = 3; i < pixels.size(); i += 4) pixels[i] = 255;
    return pixels;
}
