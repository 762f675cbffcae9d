# What `cmake --install` and the package put where: program, man page, completions, decks, meshes, manual, licence.
# Pages of the command line are printed by the program itself, so that they cannot tell of another one.

include(GNUInstallDirs)
# Debian's zsh looks in share/zsh/vendor-completions, others in share/zsh/site-functions.
set(DYGITA_ZSH_COMPLETIONS ${CMAKE_INSTALL_DATADIR}/zsh/site-functions CACHE STRING "Folder of zsh's completions, below the prefix")

set(pages ${CMAKE_BINARY_DIR}/pages)
file(MAKE_DIRECTORY ${pages})
# gmsh's library leaks when the process ends, which a build with sanitizers would take for a failure.
set(print_page ${CMAKE_COMMAND} -E env ASAN_OPTIONS=detect_leaks=0 $<TARGET_FILE:dygita>)
add_custom_command(
  OUTPUT ${pages}/dygita.1 ${pages}/dygita.bash ${pages}/_dygita ${pages}/dygita.fish ${pages}/dygita.lua
  COMMAND ${print_page} --man > ${pages}/dygita.1
  COMMAND ${print_page} --completion bash > ${pages}/dygita.bash
  COMMAND ${print_page} --completion zsh > ${pages}/_dygita
  COMMAND ${print_page} --completion fish > ${pages}/dygita.fish
  COMMAND ${print_page} schema --lua > ${pages}/dygita.lua
  DEPENDS dygita
  COMMENT "Printing the man page, the completions and the definitions for editors")
add_custom_target(dygita_pages ALL
  DEPENDS ${pages}/dygita.1 ${pages}/dygita.bash ${pages}/_dygita ${pages}/dygita.fish ${pages}/dygita.lua)

install(TARGETS dygita RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS dygita-mesher RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/dygita)
install(FILES ${pages}/dygita.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${pages}/dygita.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME dygita)
install(FILES ${pages}/_dygita DESTINATION ${DYGITA_ZSH_COMPLETIONS})
install(FILES ${pages}/dygita.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
install(FILES ${pages}/dygita.lua DESTINATION ${CMAKE_INSTALL_DATADIR}/dygita/editor)

# Decks find their meshes beside them: ../meshes.
install(DIRECTORY decks meshes DESTINATION ${CMAKE_INSTALL_DATADIR}/dygita
  FILES_MATCHING PATTERN *.lua PATTERN *.geo PATTERN *.msh PATTERN *.step PATTERN *.csv)
install(FILES README.md CHANGELOG.md CITATION.cff LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY manual DESTINATION ${CMAKE_INSTALL_DOCDIR}
  FILES_MATCHING PATTERN *.md PATTERN *.svg PATTERN *.png PATTERN *.bib PATTERN *.lua)
install(FILES ${CMAKE_SOURCE_DIR}/cmake/debian_copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
