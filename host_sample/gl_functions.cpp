#include "gl_functions.h"

#include "error.h"

namespace host {

namespace {

template <class Function>
void find(Function& function, const char* name) {
    function = reinterpret_cast<Function>(glfwGetProcAddress(name));
}

template <class Function>
void require(Function& function, const char* name) {
    find(function, name);
    if (!function) throw InputError(std::string("the OpenGL driver lacks ") + name);
}

} // namespace

GlFunctions GlFunctions::load() {
    GlFunctions gl;
    require(gl.CreateShader, "glCreateShader");
    require(gl.ShaderSource, "glShaderSource");
    require(gl.CompileShader, "glCompileShader");
    require(gl.GetShaderiv, "glGetShaderiv");
    require(gl.GetShaderInfoLog, "glGetShaderInfoLog");
    require(gl.DeleteShader, "glDeleteShader");
    require(gl.CreateProgram, "glCreateProgram");
    require(gl.AttachShader, "glAttachShader");
    require(gl.BindAttribLocation, "glBindAttribLocation");
    require(gl.LinkProgram, "glLinkProgram");
    require(gl.GetProgramiv, "glGetProgramiv");
    require(gl.UseProgram, "glUseProgram");
    require(gl.DeleteProgram, "glDeleteProgram");
    require(gl.GetUniformLocation, "glGetUniformLocation");
    require(gl.Uniform1f, "glUniform1f");
    require(gl.Uniform1i, "glUniform1i");
    require(gl.GenBuffers, "glGenBuffers");
    require(gl.BindBuffer, "glBindBuffer");
    require(gl.BufferData, "glBufferData");
    require(gl.DeleteBuffers, "glDeleteBuffers");
    require(gl.VertexAttribPointer, "glVertexAttribPointer");
    require(gl.EnableVertexAttribArray, "glEnableVertexAttribArray");
    find(gl.GenVertexArrays, "glGenVertexArrays");
    find(gl.BindVertexArray, "glBindVertexArray");
    find(gl.DeleteVertexArrays, "glDeleteVertexArrays");
    return gl;
}

} // namespace host
