# Writes the checkout's commit into a header, touching it only when it changed. "unknown" if the sources
# are no checkout themselves: an archive inside another repository must not take that one's commit.
set(commit "unknown")
if(EXISTS ${SOURCE_DIR}/.git)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -E env --unset=GIT_DIR --unset=GIT_WORK_TREE
      git --no-optional-locks -c safe.directory=${SOURCE_DIR} -C ${SOURCE_DIR}
      describe --always --abbrev=12 --dirty --exclude=*
    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    set(commit "${described}")
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define VITRUVIA_COMMIT \"${commit}\"\n")
