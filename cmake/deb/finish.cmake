# What Debian wants of the installed tree, and nobody else: run by CPack before it makes the package.
file(GLOB_RECURSE found "${CPACK_TEMPORARY_DIRECTORY}/usr/share/doc/canopen-conform/README.md")
list(GET found 0 readme)
get_filename_component(documents "${readme}" DIRECTORY)
file(REMOVE "${documents}/LICENSE") # is in the file copyright
file(COPY_FILE "${CPACK_CONFORM_COPYRIGHT}" "${documents}/copyright")
file(COPY_FILE "${CPACK_CONFORM_CHANGELOG}" "${documents}/changelog")
# Debian's zsh looks into no site-functions below /usr.
file(RENAME "${documents}/../../zsh/site-functions" "${documents}/../../zsh/vendor-completions")
file(GLOB pages "${documents}/../../man/man1/*.1")
execute_process(COMMAND gzip --best --no-name "${documents}/changelog" ${pages} COMMAND_ERROR_IS_FATAL ANY)
file(CHMOD "${documents}/copyright" "${documents}/changelog.gz" PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
