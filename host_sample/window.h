#pragma once

#include <memory>
#include <string>

#include "walker.h"

struct GLFWwindow;

namespace host {

// What was pressed since the last poll.
struct Presses {
    bool toggle_walking = false, next_view = false, next_camera = false, screenshot = false;
};

// A window with a GL context, and the mouse and keyboard that belong to it.
class Window {
  public:
    // Null, and a sentence why, if there is no display or no usable GL.
    static std::unique_ptr<Window> open(int width, int height, std::string& cause);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    bool modern_gl() const { return m_modern; } // 3.3 or later
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

    GLFWwindow* m_window;
    bool m_modern;
    bool m_captured = false, m_has_cursor = false;
    double m_cursor_x = 0.0, m_cursor_y = 0.0;
    glm::vec2 m_turn{0.0f};
    Presses m_presses;
    bool m_held[512] = {}; // by GLFW's key
};

} // namespace host
