# Third-party and standard headers that most files include, compiled once for each set of flags. Files
# include what they need all the same: the presets debug and tidy build without this.
#
# optimise_outside_frames(TARGET): the flags of code that works on no pixels and no vertices.
function(optimise_outside_frames target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# add_precompiled_headers(SET): SET is frames, outside_frames or tests; needs vitruvia_options.
function(add_precompiled_headers set)
  if(NOT VITRUVIA_PCH)
    return()
  endif()
  file(WRITE ${CMAKE_BINARY_DIR}/precompiled_${set}.cpp "")
  add_library(vitruvia_precompiled_${set} OBJECT ${CMAKE_BINARY_DIR}/precompiled_${set}.cpp)
  set_target_properties(vitruvia_precompiled_${set} PROPERTIES UNITY_BUILD OFF)
  target_link_libraries(vitruvia_precompiled_${set} PRIVATE
    vitruvia_options fmt::fmt nlohmann_json::nlohmann_json Eigen3::Eigen)
  set(headers <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory> <optional> <string>
    <vector> <Eigen/Cholesky> <Eigen/Core> <Eigen/Geometry> <fmt/format.h> <nlohmann/json.hpp>)
  if(set STREQUAL "tests")
    target_link_libraries(vitruvia_precompiled_tests PRIVATE GTest::gtest GTest::gmock)
    list(APPEND headers <gmock/gmock.h> <gtest/gtest.h>)
  endif()
  if(NOT set STREQUAL "frames")
    optimise_outside_frames(vitruvia_precompiled_${set})
  endif()
  target_precompile_headers(vitruvia_precompiled_${set} PRIVATE ${headers})
endfunction()

function(use_precompiled_headers target set)
  if(VITRUVIA_PCH)
    target_link_libraries(${target} PRIVATE fmt::fmt nlohmann_json::nlohmann_json Eigen3::Eigen)
    target_precompile_headers(${target} REUSE_FROM vitruvia_precompiled_${set})
  endif()
endfunction()
