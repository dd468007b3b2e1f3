# add_module(NAME [OUTSIDE_FRAMES] [FOLDERS folder...] [DEPENDS module...] [LINKS target...]
#            [OFFERS prefix...] [HIDES prefix...])
#
# One library per folder: vitruvia_NAME, made of every *.cpp of the calling folder.
#   FOLDERS  folders below it whose *.cpp belong to the module too
#   OUTSIDE_FRAMES  nothing in it works on pixels or vertices: a release compiles it with -O1, which
#            takes three quarters of the time
#   DEPENDS  modules whose headers it may include (tests/lint holds the #include lines against this list)
#   LINKS    third-party targets
#   OFFERS   third-party header prefixes that come in with this module; every module above may include them
#   HIDES    third-party header prefixes that only this module's own files may include
function(add_module name)
  cmake_parse_arguments(ARG "OUTSIDE_FRAMES" "" "FOLDERS;DEPENDS;LINKS;OFFERS;HIDES" ${ARGN})
  set(patterns *.cpp)
  foreach(folder ${ARG_FOLDERS})
    list(APPEND patterns ${folder}/*.cpp)
  endforeach()
  file(GLOB sources CONFIGURE_DEPENDS ${patterns})
  list(TRANSFORM ARG_DEPENDS PREPEND vitruvia_)
  if(sources)
    add_library(vitruvia_${name} STATIC ${sources})
    target_link_libraries(vitruvia_${name} PUBLIC vitruvia_options ${ARG_DEPENDS} ${ARG_LINKS})
    if(ARG_OUTSIDE_FRAMES)
      optimise_outside_frames(vitruvia_${name})
      use_precompiled_headers(vitruvia_${name} outside_frames)
    else()
      use_precompiled_headers(vitruvia_${name} frames)
    endif()
  else()
    add_library(vitruvia_${name} INTERFACE)
    target_link_libraries(vitruvia_${name} INTERFACE vitruvia_options ${ARG_DEPENDS} ${ARG_LINKS})
  endif()
endfunction()

# add_module_tests(NAME [NEEDS module...]): one test program of every *_test.cpp of the calling folder.
function(add_module_tests name)
  cmake_parse_arguments(ARG "" "" "NEEDS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *_test.cpp)
  add_executable(${name}_tests ${sources})
  list(TRANSFORM ARG_NEEDS PREPEND vitruvia_)
  target_link_libraries(${name}_tests PRIVATE ${ARG_NEEDS} vitruvia_test_support)
  optimise_outside_frames(${name}_tests)
  use_precompiled_headers(${name}_tests tests)
  set(timeout_s 240)
  if(VITRUVIA_SANITIZE)
    set(timeout_s 1200)
  endif()
  gtest_discover_tests(${name}_tests TEST_PREFIX ${name}. DISCOVERY_MODE PRE_TEST
    PROPERTIES TIMEOUT ${timeout_s})
endfunction()
