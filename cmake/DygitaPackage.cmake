# A .deb by CPack: cmake --workflow --preset package, or cpack -G DEB in a build folder.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME dygita)
set(CPACK_PACKAGE_VENDOR "The Dygita developers")
set(CPACK_PACKAGE_CONTACT "The Dygita developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "shock propagation through bolted assemblies")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
  "Computes how a shock goes through a bolted assembly with contact, friction,\nseparation, tightening and yielding on its interfaces (dynamic LATIN method).\nDecks are Lua programs; results are files for ParaView, CSV tables and a report.")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # dependencies are read off the program
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
if(DYGITA_NATIVE)
  # Elsewhere it may stop with an illegal instruction.
  string(APPEND CPACK_DEBIAN_PACKAGE_DESCRIPTION "\nFOR THE PROCESSOR OF THE MACHINE THAT BUILT IT ONLY (DYGITA_NATIVE).")
  message(STATUS "A package from this build is for this kind of processor only; one to share: preset 'package'")
endif()
include(CPack)
