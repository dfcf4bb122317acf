# The library is compiled with -O2, but for the folders in which answers spend their time, which are
# compiled with -O3. Shares are of the CPU time of 13 questions to `diagnose` and `identify`, or of `fit`,
# as perf samples it. A build that asks for something else than -O2 has it everywhere.
set(lacuna_fast_folders
  src/core/numerics               #  8 %: products, decompositions, sampled signals
  src/identify/forms_beside       #  4 %: rows of candidates
  src/model/expressions           #  7 %: values of equations
  src/records/channels            #  4 %: delayed and held inputs
  src/regression/linear           #  2 %: statistics of rows; 11 % of identify
  src/trajectories/fit            # 15 % of fit: runs with derivatives
  src/trajectories/refiners       #  3 %: steps with derivatives
  src/trajectories/sensitivities  # 15 %: what steps do with changes of the state
  src/trajectories/shooting       #  2 % of identify: fits of stretches
  src/trajectories/smoother       # 31 %: filters and smoothers, responses to columns
  src/trajectories/windows)       #  6 % of identify: fits of windows
foreach(folder IN LISTS lacuna_fast_folders)
  if(NOT IS_DIRECTORY ${PROJECT_SOURCE_DIR}/${folder})
    message(FATAL_ERROR "cmake/Optimisation.cmake: there is no folder ${folder}")
  endif()
endforeach()

set(lacuna_fast_option "")
if(CMAKE_CXX_FLAGS_RELEASE MATCHES "-O2")
  set(lacuna_fast_option $<$<CONFIG:Release>:-O3>)
endif()
