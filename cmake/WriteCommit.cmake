# Writes the checkout's commit into a header, touching it only when it changed.
execute_process(COMMAND git --no-optional-locks -c safe.directory=${SOURCE_DIR} -C ${SOURCE_DIR}
    describe --always --abbrev=12 --dirty --exclude=*
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define VITRUVIA_COMMIT \"${commit}\"\n")
