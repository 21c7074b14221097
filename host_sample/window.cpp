#include "window.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include <GLFW/glfw3.h>

namespace host {

namespace {

GLFWwindow* create(const char* title, int width, int height, bool modern) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, modern ? 3 : 2);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, modern ? 3 : 1);
    if (modern) {
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    }
    return glfwCreateWindow(width, height, title, nullptr, nullptr);
}

std::string last_error() {
    const char* description = nullptr;
    glfwGetError(&description);
    return description ? description : "no cause is known";
}

struct Area {
    int x = 0, y = 0, width = 0, height = 0;
    bool contains(int px, int py) const {
        return px >= x && px < x + width && py >= y && py < y + height;
    }
};

Area work_area(GLFWmonitor* monitor) {
    Area area;
    if (monitor) glfwGetMonitorWorkarea(monitor, &area.x, &area.y, &area.width, &area.height);
    return area;
}

// Of the screen that has the middle of the window, or of the first one.
Area work_area_of(GLFWwindow* window) {
    int x = 0, y = 0, width = 0, height = 0, count = 0;
    glfwGetWindowPos(window, &x, &y);
    glfwGetWindowSize(window, &width, &height);
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    for (int i = 0; i < count; ++i) {
        const Area area = work_area(monitors[i]);
        if (area.contains(x + width / 2, y + height / 2)) return area;
    }
    return work_area(glfwGetPrimaryMonitor());
}

void fit(const Area& area, int& width, int& height) {
    if (area.width > 0) width = std::min(width, area.width);
    if (area.height > 0) height = std::min(height, area.height);
}

bool has_display() {
    const auto set = [](const char* name) {
        const char* value = std::getenv(name);
        return value && *value;
    };
    return set("DISPLAY") || set("WAYLAND_DISPLAY");
}

std::optional<Key> to_key(int code) {
    switch (code) {
    case GLFW_KEY_W:
        return Key::w;
    case GLFW_KEY_A:
        return Key::a;
    case GLFW_KEY_S:
        return Key::s;
    case GLFW_KEY_D:
        return Key::d;
    case GLFW_KEY_UP:
        return Key::up;
    case GLFW_KEY_DOWN:
        return Key::down;
    case GLFW_KEY_LEFT:
        return Key::left;
    case GLFW_KEY_RIGHT:
        return Key::right;
    case GLFW_KEY_LEFT_SHIFT:
    case GLFW_KEY_RIGHT_SHIFT:
        return Key::shift;
    case GLFW_KEY_LEFT_CONTROL:
    case GLFW_KEY_RIGHT_CONTROL:
        return Key::control;
    case GLFW_KEY_C:
        return Key::c;
    case GLFW_KEY_E:
        return Key::e;
    case GLFW_KEY_F:
        return Key::f;
    case GLFW_KEY_G:
        return Key::g;
    case GLFW_KEY_P:
        return Key::p;
    case GLFW_KEY_V:
        return Key::v;
    case GLFW_KEY_SPACE:
        return Key::space;
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
        return Key::enter;
    case GLFW_KEY_ESCAPE:
        return Key::escape;
    case GLFW_KEY_F12:
        return Key::f12;
    default:
        return std::nullopt;
    }
}

Window& of(GLFWwindow* window) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

} // namespace

std::unique_ptr<Window> Window::open(const std::string& title, int width, int height, bool fits,
                                     std::string& cause) {
    if (!has_display()) {
        cause = "there is no display";
        return nullptr;
    }
    if (!glfwInit()) {
        cause = "no window system can be used (" + last_error() + ")";
        return nullptr;
    }
    if (fits) fit(work_area(glfwGetPrimaryMonitor()), width, height);
    bool modern = true;
    GLFWwindow* window = create(title.c_str(), width, height, true);
    if (!window) {
        modern = false;
        window = create(title.c_str(), width, height, false);
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
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int) {
        of(window).on_button(button, action);
    });
    glfwSetWindowFocusCallback(
        window_, [](GLFWwindow* window, int focused) { of(window).on_focus(focused != 0); });
}

void Window::capture_mouse(bool captured) {
    if (captured == desk_.captured) return;
    desk_.captured = captured;
    has_cursor_ = false;
    glfwSetInputMode(window_, GLFW_CURSOR, captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
}

void Window::on_key(int code, int action) {
    const auto key = to_key(code);
    if (!key || action == GLFW_REPEAT) return;
    desk_.held.set(*key, action == GLFW_PRESS);
    if (action == GLFW_PRESS) desk_.pressed.set(*key);
}

void Window::on_button(int button, int action) {
    if (button != GLFW_MOUSE_BUTTON_LEFT) return;
    desk_.held.set(Key::mouse, action == GLFW_PRESS);
    if (action == GLFW_PRESS) desk_.pressed.set(Key::mouse);
}

void Window::on_cursor(double x, double y) {
    const glm::dvec2 way(x - cursor_x_, y - cursor_y_);
    if (desk_.captured && has_cursor_) desk_.motion += glm::vec2(way);
    if (has_cursor_) desk_.pointer_moved = true;
    cursor_x_ = x;
    cursor_y_ = y;
    has_cursor_ = true;
}

// A key that is let go over another window must not stay held.
void Window::on_focus(bool focused) {
    focused_ = focused;
    if (!focused) desk_.held.clear();
}

bool Window::closing() const {
    return glfwWindowShouldClose(window_) != 0;
}

void Window::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void Window::framebuffer_size(int& width, int& height) const {
    glfwGetFramebufferSize(window_, &width, &height);
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}

void Window::set_fullscreen(bool fullscreen) {
    if (fullscreen == (glfwGetWindowMonitor(window_) != nullptr)) return;
    if (!fullscreen) {
        glfwSetWindowMonitor(window_, nullptr, place_[0], place_[1], place_[2], place_[3], 0);
        return;
    }
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    if (!mode) return;
    glfwGetWindowPos(window_, &place_[0], &place_[1]);
    glfwGetWindowSize(window_, &place_[2], &place_[3]);
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::largest(int& width, int& height) const {
    width = height = 16384;
    fit(work_area_of(window_), width, height);
    if (glfwGetWindowMonitor(window_)) return;
    int left = 0, top = 0, right = 0, bottom = 0; // of what the system draws around it
    glfwGetWindowFrameSize(window_, &left, &top, &right, &bottom);
    width -= left + right;
    height -= top + bottom;
}

bool Window::minimised() const {
    return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0
           || glfwGetWindowAttrib(window_, GLFW_VISIBLE) == 0;
}

void Window::resize(int width, int height) {
    int most_width = 0, most_height = 0;
    largest(most_width, most_height);
    width = std::min(width, most_width);
    height = std::min(height, most_height);
    place_[2] = width;
    place_[3] = height;
    if (!glfwGetWindowMonitor(window_)) glfwSetWindowSize(window_, width, height);
}

void Window::present() {
    glfwSwapBuffers(window_);
    glfwPollEvents();
}

void Window::rest(double seconds) {
    const double end = glfwGetTime() + seconds;
    double left = seconds;
    do {
        glfwWaitEventsTimeout(std::max(left, 0.0));
        left = end - glfwGetTime();
    } while (left > 0.0 && !desk_.pressed.any() && !closing());
}

Desk Window::take_desk() {
    int window_width = 0, window_height = 0, width = 0, height = 0;
    glfwGetWindowSize(window_, &window_width, &window_height);
    framebuffer_size(width, height);
    if (window_width > 0 && window_height > 0)
        desk_.pointer = glm::vec2(glm::dvec2(cursor_x_, cursor_y_) * glm::dvec2(width, height)
                                  / glm::dvec2(window_width, window_height));
    const Desk desk = desk_;
    desk_.pressed.clear();
    desk_.motion = glm::vec2(0.0f);
    desk_.pointer_moved = false;
    return desk;
}

} // namespace host
