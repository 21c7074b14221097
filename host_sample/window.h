#pragma once

#include <memory>
#include <string>

#include "walker.h"

struct GLFWwindow;

namespace host {

// How often what was pressed since the last poll.
struct Presses {
    uint32_t toggle_walking = 0, next_view = 0, next_camera = 0, screenshot = 0;
};

// A window with a GL context, and the mouse and keyboard that belong to it.
class Window {
public:
    // Null, and a sentence why, if there is no display or no usable GL.
    static std::unique_ptr<Window> open(int width, int height, std::string& cause);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    bool modern_gl() const { return modern_; } // 3.3 or later
    bool closing() const;
    void framebuffer_size(int& width, int& height) const;
    void set_title(const std::string& title);
    void present(); // swaps and polls

    Controls controls(); // and resets what the mouse has moved
    Presses take_presses();

private:
    Window(GLFWwindow* window, bool modern);
    void install_callbacks();
    void capture_mouse(bool captured);
    void on_key(int key, int action);
    void on_cursor(double x, double y);

    GLFWwindow* window_;
    bool modern_;
    bool captured_ = false, has_cursor_ = false;
    double cursor_x_ = 0.0, cursor_y_ = 0.0;
    glm::vec2 turn_{0.0f};
    Presses presses_;
    bool held_[512] = {}; // by GLFW's key
};

} // namespace host
