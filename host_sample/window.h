#pragma once

#include <memory>
#include <string>

#include "desk.h"

struct GLFWwindow;

namespace host {

// A window with a GL context, and the mouse and keyboard that belong to it.
class Window {
public:
    // Null, and a sentence why, if there is no display or no usable GL. With `fits` no larger than
    // the screen has room for.
    static std::unique_ptr<Window> open(const std::string& title, int width, int height, bool fits,
                                        std::string& cause);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    bool modern_gl() const { return modern_; } // 3.3 or later
    bool closing() const;
    void close();
    void framebuffer_size(int& width, int& height) const;
    void set_title(const std::string& title);
    void set_fullscreen(bool fullscreen);
    // Also what a full screen goes back to. No larger than the screen has room for.
    void resize(int width, int height);
    void largest(int& width, int& height) const; // of a window on the screen that it is on
    bool minimised() const;                      // nobody sees it
    void present();                              // swaps and polls
    // Sleeps for so long, but for input.
    void rest(double seconds);

    Desk take_desk(); // and begins anew
    bool captured() const { return desk_.captured; }
    void capture_mouse(bool captured);
    bool focused() const { return focused_; }

private:
    Window(GLFWwindow* window, bool modern);
    void install_callbacks();
    void on_key(int key, int action);
    void on_button(int button, int action);
    void on_cursor(double x, double y);
    void on_focus(bool focused);

    GLFWwindow* window_;
    bool modern_;
    Desk desk_;
    bool has_cursor_ = false, focused_ = true;
    double cursor_x_ = 0.0, cursor_y_ = 0.0;
    int place_[4] = {}; // x, y, width and height before it became full screen
};

} // namespace host
