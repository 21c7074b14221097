# Plays the recorded run and expects it to be won, with the recorded hash (of which the program makes
# sure) and the same last line on all instruction sets that this machine has, with one thread and two.
set(lines "")
foreach(isa scalar sse4 avx2 avx512)
  foreach(threads 1 2)
    execute_process(
      COMMAND ${PROGRAM} --headless --quiet --replay ${REPLAY} --isa ${isa} --threads ${threads}
      RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE error)
    if(error MATCHES "RT_ERROR_UNSUPPORTED")
      message(STATUS "${isa}: not on this machine")
      continue()
    endif()
    if(NOT status EQUAL 0 OR NOT out MATCHES "WON [0-9a-f]+\n$")
      message(FATAL_ERROR "${isa}, ${threads} threads: exit status ${status}\n${out}${error}")
    endif()
    list(APPEND lines ${out})
  endforeach()
endforeach()
list(REMOVE_DUPLICATES lines)
list(LENGTH lines count)
if(NOT count EQUAL 1)
  message(FATAL_ERROR "not one end, but ${count}: ${lines}")
endif()
message(STATUS "${lines}")

# What is cut off, or of another level, is refused with a sentence.
file(READ ${REPLAY} bytes LIMIT 1000 HEX)
file(WRITE ${SCRATCH} "${bytes}")
execute_process(COMMAND ${PROGRAM} --headless --quiet --replay ${SCRATCH}
  RESULT_VARIABLE status ERROR_VARIABLE error)
if(NOT status EQUAL 2 OR error STREQUAL "")
  message(FATAL_ERROR "a broken replay: exit status ${status}, ${error}")
endif()
execute_process(COMMAND ${PROGRAM} --headless --quiet --replay ${REPLAY} --scene ${OTHER_LEVEL}
  RESULT_VARIABLE status ERROR_VARIABLE error)
if(NOT status EQUAL 2 OR NOT error MATCHES "another level")
  message(FATAL_ERROR "a replay of another level: exit status ${status}, ${error}")
endif()
