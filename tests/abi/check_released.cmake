cmake_minimum_required(VERSION 3.25)
# Every struct of a RELEASED layout lives on in the one that PROGRAM prints: its fields are where
# they were, and only a struct that carries its size may have grown.
execute_process(COMMAND ${PROGRAM} OUTPUT_VARIABLE layout COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "\n" ";" now "${layout}")
file(STRINGS ${RELEASED} released)
foreach(line IN LISTS released)
  if("${line}" IN_LIST now)
    continue()
  endif()
  if(line MATCHES "^struct (rt_[a-z_0-9]+) ([0-9]+)$")
    set(name ${CMAKE_MATCH_1})
    set(old_size ${CMAKE_MATCH_2})
    if(layout MATCHES "struct ${name} ([0-9]+)\n"
       AND CMAKE_MATCH_1 GREATER old_size
       AND layout MATCHES "${name}\\.struct_size 0 4\n")
      continue()
    endif()
  endif()
  message(SEND_ERROR "released, but no longer so: ${line}")
endforeach()

# ... and every function and constant of the released header is still declared.
file(STRINGS ${OLD_HEADER} old REGEX "^RT_EXPORT |^    RT_[A-Z0-9_]+ =|RT_[A-Z0-9_]+ = [0-9]")
file(READ ${HEADER} header)
foreach(line IN LISTS old)
  string(REGEX MATCHALL "(rt_[a-z_]+\\()|(RT_[A-Z0-9_]+ = [0-9a-z<u ]+)" names "${line}")
  foreach(name IN LISTS names)
    string(STRIP "${name}" name) # a constant that is not the last any more is followed by a comma
    string(FIND "${header}" "${name}" place)
    if(place EQUAL -1)
      message(SEND_ERROR "released, but no longer declared: ${name}")
    endif()
  endforeach()
endforeach()
