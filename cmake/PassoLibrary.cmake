# libpasso, the shared library, its installation, and the Python module: docs/library.md.
#
# passo_shared_library(): called by the module library, after its own target. The objects of the module give the
# library its interface; all other modules are inside, with hidden names.
function(passo_shared_library)
  if(NOT PASSO_SHARED_LIBRARY)
    return()
  endif()
  passo_layers(library layers)
  list(TRANSFORM layers PREPEND "passo_")
  add_library(passo_shared SHARED $<TARGET_OBJECTS:passo_library>)
  target_link_libraries(passo_shared PRIVATE ${layers} fmt::fmt PNG::PNG)
  set(shown "${PROJECT_SOURCE_DIR}/cmake/libpasso.map")
  target_link_options(passo_shared PRIVATE "-Wl,--version-script=${shown}" -Wl,--as-needed -Wl,-z,defs)
  set_target_properties(passo_shared PROPERTIES LINK_DEPENDS "${shown}")
  target_include_directories(passo_shared INTERFACE
    "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>" "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  target_compile_features(passo_shared INTERFACE cxx_std_17)
  # The number of the SONAME is PASSO_LIBRARY_INTERFACE.
  set_target_properties(passo_shared PROPERTIES OUTPUT_NAME passo EXPORT_NAME passo SOVERSION 1
    LINKER_LANGUAGE CXX
    LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")

  include(CMakePackageConfigHelpers)
  set(folder "${CMAKE_INSTALL_LIBDIR}/cmake/passo")
  set(made "${CMAKE_CURRENT_BINARY_DIR}")
  install(TARGETS passo_shared EXPORT passoTargets LIBRARY
    DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library NAMELINK_COMPONENT development)
  install(DIRECTORY include/passo DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT development)
  install(EXPORT passoTargets NAMESPACE passo:: DESTINATION "${folder}" COMPONENT development)
  configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/passoConfig.cmake.in" "${made}/passoConfig.cmake"
    INSTALL_DESTINATION "${folder}" PATH_VARS CMAKE_INSTALL_BINDIR NO_CHECK_REQUIRED_COMPONENTS_MACRO)
  # Before 1.0.0 a minor version may change anything.
  set(compatible SameMajorVersion)
  if(PROJECT_VERSION VERSION_LESS 1)
    set(compatible SameMinorVersion)
  endif()
  write_basic_package_version_file("${made}/passoConfigVersion.cmake" COMPATIBILITY ${compatible})
  install(FILES "${made}/passoConfig.cmake" "${made}/passoConfigVersion.cmake" DESTINATION "${folder}"
    COMPONENT development)
endfunction()

# passo_python_module(): build/…/python/passo, the package; PYTHONPATH=build/release/python finds it.
function(passo_python_module)
  # Debian's pybind11 and numpy belong to Debian's Python, whatever other one comes first in the PATH.
  if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python_EXECUTABLE /usr/bin/python3)
  endif()
  if(PASSO_SHARED_LIBRARY AND NOT CMAKE_CROSSCOMPILING)
    find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)
    find_package(pybind11 2.10 QUIET)
  endif()
  if(NOT pybind11_FOUND OR NOT Python_FOUND)
    message(STATUS "No pybind11, or no libpasso: no Python module")
    return()
  endif()
  set(package "${PROJECT_BINARY_DIR}/python/passo")
  pybind11_add_module(passo_python MODULE NO_EXTRAS python/core.cpp python/operations.cpp)
  target_link_libraries(passo_python PRIVATE passo_shared)
  # It waits for the library. -Os: a quarter less time to compile.
  target_compile_options(passo_python PRIVATE $<$<CONFIG:Release>:-Os> -fvisibility=hidden)
  set_target_properties(passo_python PROPERTIES OUTPUT_NAME _core LIBRARY_OUTPUT_DIRECTORY "${package}"
    UNITY_BUILD ${PASSO_TOGETHER})
  file(GLOB sources CONFIGURE_DEPENDS python/passo/*.py python/passo/*.pyi python/passo/py.typed)
  add_custom_command(TARGET passo_python POST_BUILD COMMAND "${CMAKE_COMMAND}" -E copy ${sources} "${package}" VERBATIM)
  set(PASSO_PYTHON_FOLDER "lib/python3/dist-packages" CACHE STRING "Where the Python package is installed, below the prefix")
  install(TARGETS passo_python LIBRARY DESTINATION "${PASSO_PYTHON_FOLDER}/passo" COMPONENT python)
  install(FILES ${sources} DESTINATION "${PASSO_PYTHON_FOLDER}/passo" COMPONENT python)
endfunction()
