# Code of pages, for the tests of this project and for tests/consumer, which sees only what is installed.

# All blocks of C++ of a page, one behind the other.
function(lacuna_cpp_of_page page result)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page})
  file(READ ${page} text)
  string(REPLACE ";" "<semicolon>" text "${text}")
  string(REGEX MATCHALL "```cpp\n[^`]*```" blocks "${text}")
  if(NOT blocks)
    message(FATAL_ERROR "${page} has no C++")
  endif()
  string(REGEX REPLACE "```(cpp)?;?" "" blocks "${blocks}")
  string(REPLACE "<semicolon>" ";" blocks "${blocks}")
  set(${result} "${blocks}" PARENT_SCOPE)
endfunction()
