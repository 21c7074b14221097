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

// The curve of RT_TONE_FILMIC, then the sRGB encoding (IEC 61966-2-1). The debug views are no
// radiance: the engine writes their values to 8-bit frames as they are, and so does this.
constexpr const char* radiance_body = R"(
in vec2 place;
out vec4 color;
uniform sampler2D picture;
uniform float exposure;
uniform int map_tones;
vec3 map_radiance(vec3 radiance) {
    vec3 x = exposure * radiance;
    vec3 c = clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
    vec3 linear_part = 12.92 * c;
    vec3 power_part = 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055;
    return mix(linear_part, power_part, step(0.0031308, c));
}
void main() {
    vec3 c = texture(picture, place).rgb;
    color = vec4(map_tones != 0 ? map_radiance(c) : clamp(c, 0.0, 1.0), 1.0);
}
)";

constexpr const char* finished_body = R"(
varying vec2 place;
uniform sampler2D picture;
void main() { gl_FragColor = vec4(texture2D(picture, place).rgb, 1.0); }
)";

std::string vertex_source(bool modern) {
    return std::string(modern
                           ? "#version 330 core\n#define attribute_in in\n#define varying_out out\n"
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

Presenter::Presenter(bool modern) : modern_(modern), gl_(GlFunctions::load()) {
    program_ = build_program(gl_, modern);
    exposure_ = gl_.GetUniformLocation(program_, "exposure");
    map_tones_ = gl_.GetUniformLocation(program_, "map_tones");
    if (gl_.GenVertexArrays && modern) {
        gl_.GenVertexArrays(1, &vertex_array_);
        gl_.BindVertexArray(vertex_array_);
    }
    const float corners[] = {-1.0f, -1.0f, 3.0f, -1.0f, -1.0f, 3.0f};
    gl_.GenBuffers(1, &corners_);
    gl_.BindBuffer(GL_ARRAY_BUFFER, corners_);
    gl_.BufferData(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STATIC_DRAW);
    gl_.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
    gl_.EnableVertexAttribArray(0);
    glGenTextures(1, &texture_);
    glBindTexture(GL_TEXTURE_2D, texture_);
    for (const int filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, static_cast<GLenum>(filter), GL_LINEAR);
    for (const int wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTexParameteri(GL_TEXTURE_2D, static_cast<GLenum>(wrap), GL_CLAMP_TO_EDGE);
}

Presenter::~Presenter() {
    glDeleteTextures(1, &texture_);
    gl_.DeleteBuffers(1, &corners_);
    if (vertex_array_) gl_.DeleteVertexArrays(1, &vertex_array_);
    gl_.DeleteProgram(program_);
}

void Presenter::upload(const void* pixels, uint32_t width, uint32_t height) {
    const auto w = static_cast<GLsizei>(width), h = static_cast<GLsizei>(height);
    const GLenum type = modern_ ? GL_FLOAT : GL_UNSIGNED_BYTE;
    if (width != width_ || height != height_) {
        const GLint format = modern_ ? GL_RGBA32F : GL_RGBA8;
        glTexImage2D(GL_TEXTURE_2D, 0, format, w, h, 0, GL_RGBA, type, pixels);
        width_ = width;
        height_ = height;
    } else {
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, w, h, GL_RGBA, type, pixels);
    }
}

void Presenter::show(const void* pixels, uint32_t width, uint32_t height, int window_width,
                     int window_height, float exposure, bool map_tones) {
    upload(pixels, width, height);
    repeat(window_width, window_height, exposure, map_tones);
}

void Presenter::repeat(int window_width, int window_height, float exposure, bool map_tones) {
    glBindTexture(GL_TEXTURE_2D, texture_);
    glViewport(0, 0, window_width, window_height);
    gl_.UseProgram(program_);
    if (exposure_ >= 0) gl_.Uniform1f(exposure_, exposure);
    if (map_tones_ >= 0) gl_.Uniform1i(map_tones_, map_tones ? 1 : 0);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

} // namespace host
