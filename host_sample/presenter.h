#pragma once

#include <cstdint>

#include "gl_functions.h"

namespace host {

// Puts a frame on the window of the current GL context, stretched to it. Contexts from 3.3 on take
// radiance in 32-bit floats and map its tones in a shader; older ones take finished 8-bit pixels.
class Presenter {
public:
    explicit Presenter(bool modern);
    ~Presenter();
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;

    bool wants_radiance() const { return modern_; }

    // `pixels` are RGBA, 32-bit floats or 8 bits by wants_radiance(). Without `map_tones` floats
    // are shown as they are, clamped: for the debug views.
    void show(const void* pixels, uint32_t width, uint32_t height, int window_width,
              int window_height, float exposure, bool map_tones);

    // What was shown last, once more.
    void repeat(int window_width, int window_height, float exposure, bool map_tones);

private:
    void upload(const void* pixels, uint32_t width, uint32_t height);

    bool modern_;
    GlFunctions gl_;
    GLuint program_ = 0, corners_ = 0, vertex_array_ = 0, texture_ = 0;
    GLint exposure_ = -1, map_tones_ = -1;
    uint32_t width_ = 0, height_ = 0; // of the texture
};

} // namespace host
