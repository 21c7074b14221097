#pragma once

#include <GLFW/glfw3.h>

#include <GL/glext.h>

namespace host::ui {

// While one of these lives the fixed pipeline of GL 2 draws from the client's memory: no program,
// no buffer and no generic attribute 0, which would stand in for the place of a vertex. Others find
// theirs again afterwards.
class FixedPipeline {
public:
    FixedPipeline();
    ~FixedPipeline();
    FixedPipeline(const FixedPipeline&) = delete;
    FixedPipeline& operator=(const FixedPipeline&) = delete;

private:
    PFNGLUSEPROGRAMPROC use_program_;
    PFNGLBINDBUFFERPROC bind_buffer_;
    PFNGLENABLEVERTEXATTRIBARRAYPROC enable_;
    PFNGLDISABLEVERTEXATTRIBARRAYPROC disable_;
    GLint program_ = 0, buffer_ = 0, enabled_ = 0;
};

} // namespace host::ui
