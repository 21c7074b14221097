#include "presenter.h"

#include <string>

#include "error.h"

namespace host {

namespace {

// One triangle that covers the window; row 0 of the picture is its top.
constexpr const char* vertex_body = R"(
attribute_in vec2 corner;
varying_out vec2 place;
void main() {
    place = vec2(0.5 * corner.x + 0.5, 0.5 - 0.5 * corner.y);
    gl_Position = vec4(corner, 0.0, 1.0);
}
)";

// The curve of RT_TONE_FILMIC, then the sRGB encoding (IEC 61966-2-1).
constexpr const char* radiance_body = R"(
in vec2 place;
out vec4 color;
uniform sampler2D picture;
uniform float exposure;
uniform int map_tones;
vec3 encode(vec3 c) {
    return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}
void main() {
    vec3 c = texture(picture, place).rgb;
    if (map_tones != 0) {
        vec3 x = exposure * c;
        c = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
    }
    color = vec4(encode(clamp(c, 0.0, 1.0)), 1.0);
}
)";

constexpr const char* finished_body = R"(
varying vec2 place;
uniform sampler2D picture;
void main() { gl_FragColor = vec4(texture2D(picture, place).rgb, 1.0); }
)";

std::string vertex_source(bool modern) {
    return std::string(modern ? "#version 330 core\n#define attribute_in in\n#define varying_out out\n"
                              : "#version 120\n#define attribute_in attribute\n"
                                "#define varying_out varying\n")
         + vertex_body;
}

std::string fragment_source(bool modern) {
    return modern ? std::string("#version 330 core\n") + radiance_body
                  : std::string("#version 120\n") + finished_body;
}

void attach_shader(const GlFunctions& gl, GLuint program, GLenum kind, const std::string& source) {
    const GLuint shader = gl.CreateShader(kind);
    const char* text = source.c_str();
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    GLint compiled = 0;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (!compiled) {
        char log[512] = {};
        gl.GetShaderInfoLog(shader, sizeof log, nullptr, log);
        throw InputError(std::string("the OpenGL driver refuses a shader: ") + log);
    }
    gl.AttachShader(program, shader);
    gl.DeleteShader(shader); // lives on in the program
}

GLuint build_program(const GlFunctions& gl, bool modern) {
    const GLuint program = gl.CreateProgram();
    attach_shader(gl, program, GL_VERTEX_SHADER, vertex_source(modern));
    attach_shader(gl, program, GL_FRAGMENT_SHADER, fragment_source(modern));
    gl.BindAttribLocation(program, 0, "corner");
    gl.LinkProgram(program);
    GLint linked = 0;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) throw InputError("the OpenGL driver cannot link the shaders");
    return program;
}

} // namespace

Presenter::Presenter(bool modern) : m_modern(modern), m_gl(GlFunctions::load()) {
    m_program = build_program(m_gl, modern);
    m_exposure = m_gl.GetUniformLocation(m_program, "exposure");
    m_map_tones = m_gl.GetUniformLocation(m_program, "map_tones");
    if (m_gl.GenVertexArrays && modern) {
        m_gl.GenVertexArrays(1, &m_vertex_array);
        m_gl.BindVertexArray(m_vertex_array);
    }
    const float corners[] = {-1.0f, -1.0f, 3.0f, -1.0f, -1.0f, 3.0f};
    m_gl.GenBuffers(1, &m_corners);
    m_gl.BindBuffer(GL_ARRAY_BUFFER, m_corners);
    m_gl.BufferData(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STATIC_DRAW);
    m_gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
    m_gl.EnableVertexAttribArray(0);
    glGenTextures(1, &m_texture);
    glBindTexture(GL_TEXTURE_2D, m_texture);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
}

Presenter::~Presenter() {
    glDeleteTextures(1, &m_texture);
    m_gl.DeleteBuffers(1, &m_corners);
    if (m_vertex_array) m_gl.DeleteVertexArrays(1, &m_vertex_array);
    m_gl.DeleteProgram(m_program);
}

void Presenter::upload(const void* pixels, uint32_t width, uint32_t height) {
    const auto w = static_cast<GLsizei>(width), h = static_cast<GLsizei>(height);
    const GLenum type = m_modern ? GL_FLOAT : GL_UNSIGNED_BYTE;
    if (width != m_width || height != m_height) {
        const GLint format = m_modern ? GL_RGBA32F : GL_RGBA8;
        glTexImage2D(GL_TEXTURE_2D, 0, format, w, h, 0, GL_RGBA, type, pixels);
        m_width = width;
        m_height = height;
    } else {
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, w, h, GL_RGBA, type, pixels);
    }
}

void Presenter::show(const void* pixels, uint32_t width, uint32_t height, int window_width,
                     int window_height, float exposure, bool map_tones) {
    upload(pixels, width, height);
    glViewport(0, 0, window_width, window_height);
    m_gl.UseProgram(m_program);
    if (m_exposure >= 0) m_gl.Uniform1f(m_exposure, exposure);
    if (m_map_tones >= 0) m_gl.Uniform1i(m_map_tones, map_tones ? 1 : 0);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

} // namespace host
