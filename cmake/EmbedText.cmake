# embed_text(TARGET HEADER NAME FILE [NAME FILE]...): makes each file's text a constant of the target,
# `extern const char* const NAME` of namespace vitruvia, which HEADER (an #include path) declares.
function(embed_text target header)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${target}_text.cpp)
  set(files ${ARGN})
  set(sources "")
  list(LENGTH files count)
  math(EXPR last "${count} - 1")
  foreach(i RANGE 1 ${last} 2)
    list(GET files ${i} file)
    get_filename_component(file ${file} ABSOLUTE)
    list(APPEND sources ${file})
  endforeach()
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DHEADER=${header} "-DFILES=${files}"
            -DFOLDER=${CMAKE_CURRENT_SOURCE_DIR} -P ${CMAKE_SOURCE_DIR}/cmake/WriteEmbeddedText.cmake
    DEPENDS ${sources} ${CMAKE_SOURCE_DIR}/cmake/WriteEmbeddedText.cmake
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
  set_source_files_properties(${output} PROPERTIES
    SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
endfunction()
