#include "ui/fixed_pipeline.h"

namespace host::ui {

namespace {

template <class Function>
Function find(const char* name) {
    return reinterpret_cast<Function>(glfwGetProcAddress(name));
}

} // namespace

// The presenter has asked for all of these before: a context without shaders never comes here.
FixedPipeline::FixedPipeline()
    : use_program_(find<PFNGLUSEPROGRAMPROC>("glUseProgram")),
      bind_buffer_(find<PFNGLBINDBUFFERPROC>("glBindBuffer")),
      enable_(find<PFNGLENABLEVERTEXATTRIBARRAYPROC>("glEnableVertexAttribArray")),
      disable_(find<PFNGLDISABLEVERTEXATTRIBARRAYPROC>("glDisableVertexAttribArray")) {
    glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
    glGetIntegerv(GL_ARRAY_BUFFER_BINDING, &buffer_);
    const auto ask = find<PFNGLGETVERTEXATTRIBIVPROC>("glGetVertexAttribiv");
    ask(0, GL_VERTEX_ATTRIB_ARRAY_ENABLED, &enabled_);
    use_program_(0);
    bind_buffer_(GL_ARRAY_BUFFER, 0);
    disable_(0);
}

FixedPipeline::~FixedPipeline() {
    use_program_(static_cast<GLuint>(program_));
    bind_buffer_(GL_ARRAY_BUFFER, static_cast<GLuint>(buffer_));
    if (enabled_) enable_(0);
}

} // namespace host::ui
