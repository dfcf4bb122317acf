# lacuna_compile_options(target): warnings, sanitizers and coverage as configured.
function(lacuna_compile_options target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
    -Woverloaded-virtual)
  if(LACUNA_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(LACUNA_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=${LACUNA_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${LACUNA_SANITIZE})
  endif()
  if(LACUNA_COVERAGE)
    target_compile_options(${target} PUBLIC --coverage)
    target_link_options(${target} PUBLIC --coverage)
  endif()
endfunction()
