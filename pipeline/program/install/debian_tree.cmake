# Gives what was installed the form of a Debian package; CPack runs it before it packs.

set(root ${CPACK_TEMPORARY_DIRECTORY}/usr)
set(doc ${root}/share/doc/domefall)
# The time in all that is packed, so that the bytes do not depend on when that is.
set(ENV{SOURCE_DATE_EPOCH} ${CPACK_DOMEFALL_RELEASED})

# CPack would leave the libraries out of the dependencies, and say so among other lines.
foreach(program file dpkg-shlibdeps)
  find_program(found_${program} ${program})
  if(NOT found_${program})
    message(FATAL_ERROR "a Debian package needs ${program}: install the packages file and dpkg-dev")
  endif()
endforeach()

# Debian keeps all licences in one file.
file(REMOVE ${doc}/LICENSE ${doc}/shows/assets/LICENSE.d3-celestial)
foreach(file README.md THIRD_PARTY.md shows/assets/PROVENANCE.md)
  file(READ ${doc}/${file} text)
  string(REPLACE "[LICENSE](LICENSE)" "[copyright](copyright)" text "${text}")
  file(WRITE ${doc}/${file} "${text}")
endforeach()
configure_file(${CPACK_DOMEFALL_FILES}/copyright ${doc}/copyright COPYONLY)
configure_file(${CPACK_DOMEFALL_FILES}/changelog ${doc}/changelog.Debian COPYONLY)

file(GLOB_RECURSE binaries ${root}/bin/* ${root}/lib/*.so)
execute_process(COMMAND ${CPACK_DOMEFALL_STRIP} -R .comment -R .note ${binaries}
  COMMAND_ERROR_IS_FATAL ANY)
file(GLOB pages ${root}/share/man/man1/*.1)
execute_process(COMMAND gzip -9n ${pages} ${doc}/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND chmod -R u=rwX,go=rX ${root} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND find ${root} -exec touch -hd @${CPACK_DOMEFALL_RELEASED} {} +
  COMMAND_ERROR_IS_FATAL ANY)
