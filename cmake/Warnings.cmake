# lacuna_compile_options(target): warnings, sanitizers and coverage as configured.
function(lacuna_compile_options target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
    -Woverloaded-virtual)
  # GCC 12 warns falsely about std::string when its members are inlined (GCC bugs 105651 and
  # 105329), from precompiled headers even more.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict -Wno-stringop-overflow
      -Wno-stringop-overread -Wno-array-bounds)
  endif()
  if(LACUNA_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(LACUNA_SANITIZE)
    # What is reported ends the program: a report that nobody reads finds nothing.
    target_compile_options(${target} PUBLIC -fsanitize=${LACUNA_SANITIZE} -fno-omit-frame-pointer
      -fno-sanitize-recover=all)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
      target_compile_options(${target} PUBLIC
        -fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/cmake/sanitizer_ignorelist.txt)
    endif()
    target_link_options(${target} PUBLIC -fsanitize=${LACUNA_SANITIZE})
  endif()
  if(LACUNA_COVERAGE)
    target_compile_options(${target} PUBLIC --coverage)
    target_link_options(${target} PUBLIC --coverage)
  endif()
endfunction()
