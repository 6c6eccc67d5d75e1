# Run by cpack on what it is about to pack.

# Where this program is missing, cpack says so in passing and packs a program that asks for no library.
find_program(shlibdeps dpkg-shlibdeps)
if(NOT shlibdeps)
  message(FATAL_ERROR "dpkg-shlibdeps is missing: without it the package would not name the libraries that it needs. "
                      "Install dpkg-dev, or run .ci/setup.sh.")
endif()

# Debian wants manual pages gzipped, without time stamps.
file(GLOB_RECURSE pages ${CPACK_TEMPORARY_DIRECTORY}/*.1)
list(FILTER pages INCLUDE REGEX "/share/man/man1/")
foreach(page ${pages})
  execute_process(COMMAND gzip -9n ${page} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
