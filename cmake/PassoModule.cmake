# passo_module(NAME [SOURCES file…] [LIBRARIES target…] [TESTS file…])
#
# One module of the street: a static library passo_NAME with its public headers under
# include/passo/NAME/. What it may use is read from docs/layers.txt, the only place where that is written.
# TESTS become one test program NAME_tests.
file(STRINGS "${PROJECT_SOURCE_DIR}/docs/layers.txt" PASSO_LAYER_LINES REGEX "^[a-z_]+\\*?:")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/docs/layers.txt")

function(passo_layers module out)
  foreach(line IN LISTS PASSO_LAYER_LINES)
    if(line MATCHES "^${module}\\*?: *(.*)$")
      string(REGEX MATCHALL "[a-z_]+" names "${CMAKE_MATCH_1}")
      set(${out} "${names}" PARENT_SCOPE)
      return()
    endif()
  endforeach()
  message(FATAL_ERROR "docs/layers.txt has no line for module '${module}'")
endfunction()

function(passo_module module)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES;TESTS" ${ARGN})
  passo_layers(${module} layers)
  list(TRANSFORM layers PREPEND "passo_")

  if(ARG_SOURCES)
    add_library(passo_${module} STATIC ${ARG_SOURCES})
    target_include_directories(passo_${module} PUBLIC include)
    target_link_libraries(passo_${module} PUBLIC ${layers} PRIVATE ${ARG_LIBRARIES} passo_compiler)
  else()
    add_library(passo_${module} INTERFACE)
    target_include_directories(passo_${module} INTERFACE include)
    target_link_libraries(passo_${module} INTERFACE ${layers})
  endif()

  if(ARG_TESTS AND PASSO_BUILD_TESTS)
    passo_test(${module}_tests SOURCES ${ARG_TESTS} LIBRARIES passo_${module})
  endif()
endfunction()

# GoogleTest's headers, compiled once for all test programs.
function(passo_test_headers)
  file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/test_headers.cpp" CONTENT "")
  add_library(passo_test_headers OBJECT "${PROJECT_BINARY_DIR}/test_headers.cpp")
  target_link_libraries(passo_test_headers PRIVATE GTest::gmock GTest::gtest passo_compiler)
  target_precompile_headers(passo_test_headers PRIVATE <gmock/gmock.h> <gtest/gtest.h>)
endfunction()

# passo_test(NAME SOURCES file… LIBRARIES target… [LABELS label…] [DEFINITIONS name=value…])
#
# A GoogleTest program. Tests without a label are fast: a developer runs them at every change.
function(passo_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES;LABELS;DEFINITIONS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} GTest::gmock GTest::gtest_main passo_compiler)
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests")  # "kit/…", what tests share
  target_compile_definitions(${name} PRIVATE
    PASSO_SOURCE_DIR="${PROJECT_SOURCE_DIR}" $<$<BOOL:${PASSO_SANITIZE}>:PASSO_SANITIZED> ${ARG_DEFINITIONS})
  if(NOT TARGET passo_test_headers)
    passo_test_headers()
  endif()
  target_precompile_headers(${name} REUSE_FROM passo_test_headers)
  set(properties TIMEOUT 600)
  if(ARG_LABELS)
    list(APPEND properties LABELS "${ARG_LABELS}")
  endif()
  if(PASSO_SANITIZE)
    list(APPEND properties ENVIRONMENT "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/cmake/leaks_of_libraries.txt")
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES ${properties})
endfunction()

# passo_slow_test(NAME SECONDS COMMAND program [argument…] [ENVIRONMENT name=value…])
#
# Tests of a program that a developer would not wait for, about so long: CI runs them, the longest first, so that no
# processor stands idle at the end.
function(passo_slow_test name seconds)
  cmake_parse_arguments(ARG "" "" "COMMAND;ENVIRONMENT" ${ARGN})
  add_test(NAME ${name} COMMAND ${ARG_COMMAND})
  set_tests_properties(${name} PROPERTIES
    LABELS slow COST ${seconds} TIMEOUT 600 ENVIRONMENT "${ARG_ENVIRONMENT}")
endfunction()
