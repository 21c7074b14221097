#include "window.h"

#include <cstdlib>

#include <GLFW/glfw3.h>

namespace host {

namespace {

constexpr float radians_per_pixel = 0.0022f;
constexpr float arrow_turn = 0.03f; // a frame

GLFWwindow* create(int width, int height, bool modern) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, modern ? 3 : 2);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, modern ? 3 : 1);
    if (modern) {
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    }
    return glfwCreateWindow(width, height, "Peregrine", nullptr, nullptr);
}

std::string last_error() {
    const char* description = nullptr;
    glfwGetError(&description);
    return description ? description : "no cause is known";
}

bool has_display() {
    const auto set = [](const char* name) {
        const char* value = std::getenv(name);
        return value && *value;
    };
    return set("DISPLAY") || set("WAYLAND_DISPLAY");
}

Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

} // namespace

std::unique_ptr<Window> Window::open(int width, int height, std::string& cause) {
    if (!has_display()) {
        cause = "there is no display";
        return nullptr;
    }
    if (!glfwInit()) {
        cause = "no window system can be used (" + last_error() + ")";
        return nullptr;
    }
    bool modern = true;
    GLFWwindow* window = create(width, height, true);
    if (!window) {
        modern = false;
        window = create(width, height, false);
    }
    if (!window) {
        cause = "no window can be opened (" + last_error() + ")";
        glfwTerminate();
        return nullptr;
    }
    return std::unique_ptr<Window>(new Window(window, modern));
}

Window::Window(GLFWwindow* window, bool modern) : m_window(window), m_modern(modern) {
    glfwMakeContextCurrent(window);
    glfwSwapInterval(0); // frames come when they are ready: their time is on show
    install_callbacks();
    capture_mouse(true);
}

Window::~Window() {
    glfwDestroyWindow(m_window);
    glfwTerminate();
}

void Window::install_callbacks() {
    glfwSetWindowUserPointer(m_window, this);
    glfwSetKeyCallback(m_window, [](GLFWwindow* window, int key, int, int action, int) {
        of(window).on_key(key, action);
    });
    glfwSetCursorPosCallback(
        m_window, [](GLFWwindow* window, double x, double y) { of(window).on_cursor(x, y); });
    glfwSetMouseButtonCallback(m_window, [](GLFWwindow* window, int, int action, int) {
        if (action == GLFW_PRESS) of(window).capture_mouse(true);
    });
    // A key that is let go over another window must not stay held.
    glfwSetWindowFocusCallback(m_window, [](GLFWwindow* window, int focused) {
        if (focused) return;
        for (bool& held : of(window).m_held) held = false;
    });
}

void Window::capture_mouse(bool captured) {
    m_captured = captured;
    m_has_cursor = false;
    glfwSetInputMode(m_window, GLFW_CURSOR, captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
}

void Window::on_key(int key, int action) {
    if (key < 0 || key >= static_cast<int>(std::size(m_held))) return;
    m_held[key] = action != GLFW_RELEASE;
    if (action != GLFW_PRESS) return;
    switch (key) {
    case GLFW_KEY_F: m_presses.toggle_walking = true; break;
    case GLFW_KEY_V: m_presses.next_view = true; break;
    case GLFW_KEY_C: m_presses.next_camera = true; break;
    case GLFW_KEY_P:
    case GLFW_KEY_F12: m_presses.screenshot = true; break;
    case GLFW_KEY_ESCAPE:
        if (m_captured)
            capture_mouse(false);
        else
            glfwSetWindowShouldClose(m_window, GLFW_TRUE);
        break;
    default: break;
    }
}

void Window::on_cursor(double x, double y) {
    if (m_captured && m_has_cursor)
        m_turn += glm::vec2(static_cast<float>(m_cursor_x - x), static_cast<float>(m_cursor_y - y))
                * radians_per_pixel;
    m_cursor_x = x;
    m_cursor_y = y;
    m_has_cursor = true;
}

bool Window::closing() const { return glfwWindowShouldClose(m_window) != 0; }

void Window::framebuffer_size(int& width, int& height) const {
    glfwGetFramebufferSize(m_window, &width, &height);
}

void Window::set_title(const std::string& title) { glfwSetWindowTitle(m_window, title.c_str()); }

void Window::present() {
    glfwSwapBuffers(m_window);
    glfwPollEvents();
}

Controls Window::controls() {
    const auto axis = [this](int positive, int negative) {
        return (m_held[positive] ? 1.0f : 0.0f) - (m_held[negative] ? 1.0f : 0.0f);
    };
    Controls controls;
    controls.forward = axis(GLFW_KEY_W, GLFW_KEY_S);
    controls.right = axis(GLFW_KEY_D, GLFW_KEY_A);
    controls.up = axis(GLFW_KEY_SPACE, GLFW_KEY_LEFT_CONTROL);
    if (m_held[GLFW_KEY_RIGHT_CONTROL]) controls.up -= 1.0f;
    controls.run = m_held[GLFW_KEY_LEFT_SHIFT] || m_held[GLFW_KEY_RIGHT_SHIFT];
    controls.turn = m_turn
                  + arrow_turn
                        * glm::vec2(axis(GLFW_KEY_LEFT, GLFW_KEY_RIGHT),
                                    axis(GLFW_KEY_UP, GLFW_KEY_DOWN));
    m_turn = glm::vec2(0.0f);
    return controls;
}

Presses Window::take_presses() {
    const Presses presses = m_presses;
    m_presses = {};
    return presses;
}

} // namespace host
