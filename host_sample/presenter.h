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

    bool wants_radiance() const { return m_modern; }

    // `pixels` are RGBA, 32-bit floats or 8 bits by wants_radiance(). `map_tones` is for radiance
    // only: without it the values are shown as they are, clamped.
    void show(const void* pixels, uint32_t width, uint32_t height, int window_width,
              int window_height, float exposure, bool map_tones);

  private:
    void upload(const void* pixels, uint32_t width, uint32_t height);

    bool m_modern;
    GlFunctions m_gl;
    GLuint m_program = 0, m_corners = 0, m_vertex_array = 0, m_texture = 0;
    GLint m_exposure = -1, m_map_tones = -1;
    uint32_t m_width = 0, m_height = 0; // of the texture
};

} // namespace host
