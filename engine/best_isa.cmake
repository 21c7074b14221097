# The instruction set that the engine would choose on this machine; `all` where that is not known,
# or one without a choice. Asked at every configuration: a folder may go to another machine.
function(find_best_isa result)
  set(${result} all PARENT_SCOPE)
  if(CMAKE_CROSSCOMPILING)
    return()
  endif()
  try_run(best compiled
    SOURCE_FROM_CONTENT best_isa.cpp
      "#include \"base/isa.h\"\nint main() { return int(peregrine::base::best_isa()); }\n"
    SOURCES ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/base/isa.cpp
    NO_CACHE
    CMAKE_FLAGS -DINCLUDE_DIRECTORIES=${CMAKE_CURRENT_FUNCTION_LIST_DIR}
    CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON)
  set(names all sse4 avx2 avx512) # in the order of base::Isa; the others are all of their machine
  if(compiled AND best LESS 4)
    list(GET names ${best} name)
    set(${result} ${name} PARENT_SCOPE)
  endif()
endfunction()
