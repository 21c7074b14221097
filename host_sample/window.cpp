#include "window.h"

#include <cstdlib>

#include <GLFW/glfw3.h>

namespace host {

namespace {

constexpr float radians_per_pixel = 0.0022f;
constexpr float arrow_turn = 1.8f; // radians a second

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

Window& of(GLFWwindow* window) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

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

Window::Window(GLFWwindow* window, bool modern) : window_(window), modern_(modern) {
    glfwMakeContextCurrent(window);
    glfwSwapInterval(0); // frames come when they are ready: their time is on show
    install_callbacks();
    capture_mouse(true);
}

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

void Window::install_callbacks() {
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int) {
        of(window).on_key(key, action);
    });
    glfwSetCursorPosCallback(
        window_, [](GLFWwindow* window, double x, double y) { of(window).on_cursor(x, y); });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int, int action, int) {
        if (action == GLFW_PRESS) of(window).capture_mouse(true);
    });
    // A key that is let go over another window must not stay held.
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* window, int focused) {
        if (focused) return;
        for (bool& held : of(window).held_) held = false;
    });
}

void Window::capture_mouse(bool captured) {
    captured_ = captured;
    has_cursor_ = false;
    glfwSetInputMode(window_, GLFW_CURSOR, captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
}

void Window::on_key(int key, int action) {
    if (key < 0 || key >= static_cast<int>(std::size(held_))) return;
    held_[key] = action != GLFW_RELEASE;
    if (action != GLFW_PRESS) return;
    switch (key) {
    case GLFW_KEY_F:
        ++presses_.toggle_walking;
        break;
    case GLFW_KEY_V:
        ++presses_.next_view;
        break;
    case GLFW_KEY_C:
        ++presses_.next_camera;
        break;
    case GLFW_KEY_P:
    case GLFW_KEY_F12:
        ++presses_.screenshot;
        break;
    case GLFW_KEY_ESCAPE:
        if (captured_)
            capture_mouse(false);
        else
            glfwSetWindowShouldClose(window_, GLFW_TRUE);
        break;
    default:
        break;
    }
}

void Window::on_cursor(double x, double y) {
    if (captured_ && has_cursor_)
        turn_ += glm::vec2(static_cast<float>(cursor_x_ - x), static_cast<float>(cursor_y_ - y))
                 * radians_per_pixel;
    cursor_x_ = x;
    cursor_y_ = y;
    has_cursor_ = true;
}

bool Window::closing() const {
    return glfwWindowShouldClose(window_) != 0;
}

void Window::framebuffer_size(int& width, int& height) const {
    glfwGetFramebufferSize(window_, &width, &height);
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}

void Window::present() {
    glfwSwapBuffers(window_);
    glfwPollEvents();
}

Controls Window::controls() {
    const auto axis = [this](int positive, int negative) {
        return (held_[positive] ? 1.0f : 0.0f) - (held_[negative] ? 1.0f : 0.0f);
    };
    Controls controls;
    controls.forward = axis(GLFW_KEY_W, GLFW_KEY_S);
    controls.right = axis(GLFW_KEY_D, GLFW_KEY_A);
    controls.up = axis(GLFW_KEY_SPACE, GLFW_KEY_LEFT_CONTROL);
    if (held_[GLFW_KEY_RIGHT_CONTROL]) controls.up -= 1.0f;
    controls.run = held_[GLFW_KEY_LEFT_SHIFT] || held_[GLFW_KEY_RIGHT_SHIFT];
    controls.turn = turn_;
    controls.turn_rate =
        arrow_turn
        * glm::vec2(axis(GLFW_KEY_LEFT, GLFW_KEY_RIGHT), axis(GLFW_KEY_UP, GLFW_KEY_DOWN));
    turn_ = glm::vec2(0.0f);
    return controls;
}

Presses Window::take_presses() {
    const Presses presses = presses_;
    presses_ = {};
    return presses;
}

} // namespace host
