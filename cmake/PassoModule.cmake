# passo_module(NAME [SOURCES file…] [APART file…] [LIBRARIES target…] [TESTS file…] [TESTS_APART file…])
#
# One module of the street: a static library passo_NAME with its public headers under
# include/passo/NAME/. What it may use is read from docs/layers.txt, the only place where that is written.
# TESTS become one test program NAME_tests. They are compiled several at a time (a unity build); those whose own names
# clash with the others' are TESTS_APART. With PASSO_TOGETHER the same is done with SOURCES, except APART.
# The presets dev and clang compile each file alone, so each includes what it uses.
#
# PASSO_LAYER_LINES: its rows. PASSO_FOLDER_<module>: where a module is.
file(STRINGS "${PROJECT_SOURCE_DIR}/docs/layers.txt" PASSO_LAYER_LINES REGEX "^[a-z_]+/[a-z_]+\\*?:")
foreach(line IN LISTS PASSO_LAYER_LINES)
  if(line MATCHES "^([a-z_]+/([a-z_]+))")
    set(PASSO_FOLDER_${CMAKE_MATCH_2} "${PROJECT_SOURCE_DIR}/src/${CMAKE_MATCH_1}")
  endif()
endforeach()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/docs/layers.txt")

set(together OFF)
if(PASSO_SANITIZE OR CMAKE_BUILD_TYPE STREQUAL "Release")
  set(together ON)
endif()
option(PASSO_TOGETHER "Compile several sources of a module at a time" ${together})

# Files that are compiled together may shadow one another's names. Each alone may not: clang looks at them so.
add_library(passo_together INTERFACE)
target_compile_options(passo_together INTERFACE -Wno-shadow $<${by_gcc}:-Wno-subobject-linkage>)

# What waits for people, files and lines: a third less time to compile, and it runs hardly longer.
set(PASSO_LESS_OPTIMISED $<$<CONFIG:Release>:-O1>)
set(PASSO_LESS_OPTIMISED_MODULES activity cam carve confinement controller_file emulator grading job journal judge machine_file machine_import operations
    probing session surface_file toml tooling verdict)
# Those that call ensure(), whose message names the source. It does not name the folder in which the program was built;
# a test of the installed program finds a module that is missing here.
set(PASSO_MODULES_WITH_PLACES drive journal link stepgen trajectory)
# Tests: those that calculate have their oracles optimised a little; all others are not optimised at all.
set(PASSO_MODULES_WITH_LONG_TESTS geometry interpolate motor path stepgen trajectory)
set(PASSO_TEST_OPTIMISATION_ON $<$<CONFIG:Release>:-O1>)
set(PASSO_TEST_OPTIMISATION_OFF $<$<CONFIG:Release>:-O0>)

function(passo_layers module out)
  foreach(line IN LISTS PASSO_LAYER_LINES)
    if(line MATCHES "^[a-z_]+/${module}\\*?: *(.*)$")
      string(REGEX MATCHALL "[a-z_]+" names "${CMAKE_MATCH_1}")
      set(${out} "${names}" PARENT_SCOPE)
      return()
    endif()
  endforeach()
  message(FATAL_ERROR "docs/layers.txt has no line for module '${module}'")
endfunction()

# libpasso, a shared library, contains these modules: their code works at any address, and their names stay hidden. clang's
# precompiled headers are compiled without these options, so with clang there is no libpasso unless it is asked for.
set(shared ON)
if(PASSO_SANITIZE OR CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  set(shared OFF)
endif()
option(PASSO_SHARED_LIBRARY "Build libpasso, and the Python module if pybind11 is installed" ${shared})
set(PASSO_MODULES_IN_LIBRARY "")
if(PASSO_SHARED_LIBRARY)
  set(PASSO_MODULES_IN_LIBRARY library)
  # The lines ascend, so each line comes before those that use its module.
  set(descending ${PASSO_LAYER_LINES})
  list(REVERSE descending)
  foreach(line IN LISTS descending)
    if(line MATCHES "^[a-z_]+/([a-z_]+)\\*?: *(.*)$" AND CMAKE_MATCH_1 IN_LIST PASSO_MODULES_IN_LIBRARY)
      string(REGEX MATCHALL "[a-z_]+" names "${CMAKE_MATCH_2}")
      list(APPEND PASSO_MODULES_IN_LIBRARY ${names})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES PASSO_MODULES_IN_LIBRARY)
endif()

function(passo_module module)
  cmake_parse_arguments(ARG "" "" "SOURCES;APART;LIBRARIES;TESTS;TESTS_APART" ${ARGN})
  passo_layers(${module} layers)
  list(TRANSFORM layers PREPEND "passo_")

  if(ARG_SOURCES)
    add_library(passo_${module} STATIC ${ARG_SOURCES} ${ARG_APART})
    target_include_directories(passo_${module} PUBLIC include)
    target_link_libraries(passo_${module} PUBLIC ${layers} PRIVATE ${ARG_LIBRARIES} passo_compiler)
    if(PASSO_FOLDER_${module} MATCHES "/src/(interfaces|draw)/" OR module IN_LIST PASSO_LESS_OPTIMISED_MODULES)
      target_compile_options(passo_${module} PRIVATE ${PASSO_LESS_OPTIMISED})
    endif()
    if(PASSO_TOGETHER)
      set_target_properties(passo_${module} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 36)
      set_source_files_properties(${ARG_APART} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      target_link_libraries(passo_${module} PRIVATE passo_together)
    endif()
    if(module IN_LIST PASSO_MODULES_IN_LIBRARY)
      set_target_properties(passo_${module} PROPERTIES
        POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    endif()
    if(module IN_LIST PASSO_MODULES_WITH_PLACES)
      target_compile_options(passo_${module} PRIVATE "-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=")
    endif()
    passo_headers_once(passo_${module})
    if(PASSO_SANITIZE)
      set_target_properties(passo_${module} PROPERTIES EXCLUDE_FROM_ALL ON)
    endif()
  else()
    add_library(passo_${module} INTERFACE)
    target_include_directories(passo_${module} INTERFACE include)
    target_link_libraries(passo_${module} INTERFACE ${layers})
  endif()

  if(ARG_TESTS AND PASSO_BUILD_TESTS AND (NOT PASSO_SANITIZE OR module IN_LIST PASSO_SANITIZED_MODULES))
    set(calculates "")
    if(module IN_LIST PASSO_MODULES_WITH_LONG_TESTS)
      set(calculates CALCULATES)
    endif()
    passo_test(${module}_tests ${calculates} SOURCES ${ARG_TESTS} APART ${ARG_TESTS_APART} LIBRARIES passo_${module})
  endif()
endfunction()

# Slow tests make a part of their trials, or all of them, which takes an hour: scripts/test.sh --full.
option(PASSO_TESTS_IN_FULL "Slow tests make all of their trials" OFF)

# With PASSO_SANITIZE only the modules that read what others wrote have tests, and of the tests of the whole street one
# program (tests/CMakeLists.txt). Libraries are built that these need. PASSO_TESTS_IN_FULL adds those with the most
# arithmetic of indices.
set(PASSO_SANITIZED_MODULES gcode interpreter machine_file tooling wire link)
if(PASSO_TESTS_IN_FULL)
  list(APPEND PASSO_SANITIZED_MODULES base diagnostics geometry path trajectory firmware)
endif()

# clang reads the standard headers once for all libraries: a quarter of the time. g++ 12 needs as long to read what it has
# compiled of them; so in its builds each file includes what it uses, or does not compile.
function(passo_headers_once name)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang" OR PASSO_SHARED_LIBRARY)
    return()
  endif()
  find_package(fmt REQUIRED)
  if(NOT TARGET passo_standard_headers)
    file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/standard_headers.cpp" CONTENT "")
    add_library(passo_standard_headers OBJECT "${PROJECT_BINARY_DIR}/standard_headers.cpp")
    target_link_libraries(passo_standard_headers PRIVATE fmt::fmt passo_compiler)
    target_precompile_headers(passo_standard_headers PRIVATE <algorithm> <array> <cmath> <functional> <map> <memory>
      <optional> <ostream> <span> <string> <string_view> <utility> <variant> <vector> <fmt/format.h>)
  endif()
  target_link_libraries(${name} PRIVATE fmt::fmt)  # its macros are a part of the compiled headers
  target_precompile_headers(${name} REUSE_FROM passo_standard_headers)
endfunction()


# GoogleTest's headers, compiled once for all test programs that calculate, and once for all others, with what most of
# these include too.
function(passo_test_headers)
  find_package(fmt REQUIRED)
  find_package(nlohmann_json REQUIRED)
  file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/test_headers.cpp" CONTENT "")
  foreach(calculates IN ITEMS ON OFF)
    set(name passo_test_headers_${calculates})
    add_library(${name} OBJECT "${PROJECT_BINARY_DIR}/test_headers.cpp")
    target_link_libraries(${name} PRIVATE GTest::gmock GTest::gtest passo_compiler)
    target_compile_options(${name} PRIVATE ${PASSO_TEST_OPTIMISATION_${calculates}})
    target_precompile_headers(${name} PRIVATE <gmock/gmock.h> <gtest/gtest.h>)
  endforeach()
  passo_by_clang(passo_test_headers_OFF)
  target_link_libraries(passo_test_headers_OFF PRIVATE fmt::fmt nlohmann_json::nlohmann_json)
  target_precompile_headers(passo_test_headers_OFF PRIVATE <fmt/format.h> <nlohmann/json.hpp>)
endfunction()


# passo_test(NAME SOURCES file… [APART file…] LIBRARIES target… [LABELS label…] [SLOW filter] [ALONE filter]
#            [DEFINITIONS name=value…] [COST seconds] [PROCESSORS number] [CALCULATES])
#
# A GoogleTest program; APART as for passo_module. Tests without a label are fast: a developer runs them at every change.
# SLOW: the tests of this filter of GoogleTest get the label slow. ALONE: no other test runs beside these. COST: how long they take, as for passo_slow_test.
# PROCESSORS: how many it counts for; so many tests less run beside it. CALCULATES: its own code is worth optimising.
function(passo_test name)
  cmake_parse_arguments(ARG "CALCULATES" "COST;PROCESSORS;SLOW;ALONE" "SOURCES;APART;LIBRARIES;LABELS;DEFINITIONS" ${ARGN})
  set(one_in 0)  # of the trials of random tests, as each decides (tests/kit/in_full.hpp)
  if(PASSO_SANITIZE)
    set(one_in 16)  # a trial takes ten times as long
  elseif(PASSO_TESTS_IN_FULL)
    set(one_in 1)
  endif()
  add_executable(${name} ${ARG_SOURCES} ${ARG_APART})
  if(PASSO_TOGETHER)
    set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
    set_source_files_properties(${ARG_APART} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} GTest::gmock GTest::gtest_main passo_compiler
    $<$<BOOL:${PASSO_TOGETHER}>:passo_together>)
  set(calculates OFF)
  if(ARG_CALCULATES)
    set(calculates ON)
  else()
    target_link_libraries(${name} PRIVATE fmt::fmt nlohmann_json::nlohmann_json)  # parts of the compiled headers
  endif()
  target_compile_options(${name} PRIVATE ${PASSO_TEST_OPTIMISATION_${calculates}})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests")  # "kit/…", what tests share
  target_compile_definitions(${name} PRIVATE
    PASSO_SOURCE_DIR="${PROJECT_SOURCE_DIR}" PASSO_ONE_IN=${one_in}
    $<$<BOOL:${PASSO_SANITIZE}>:PASSO_SANITIZED> $<$<TARGET_EXISTS:motion_uno>:PASSO_MAKES_FIRMWARE> ${ARG_DEFINITIONS})
  target_precompile_headers(${name} REUSE_FROM passo_test_headers_${calculates})
  if(NOT ARG_CALCULATES)  # a number of theirs stands for a random program that g++ draws
    passo_by_clang(${name})
  endif()
  set(properties TIMEOUT 600)
  if(ARG_LABELS)
    list(APPEND properties LABELS "${ARG_LABELS}")
  endif()
  if(ARG_COST)
    list(APPEND properties COST ${ARG_COST})
  endif()
  if(ARG_PROCESSORS)
    list(APPEND properties PROCESSORS ${ARG_PROCESSORS})
  endif()
  if(PASSO_SANITIZE)
    # One process a program: under sanitizers half of a short test's time is its process's start.
    add_test(NAME ${name} COMMAND ${name})
    set_tests_properties(${name} PROPERTIES ${properties}
      ENVIRONMENT "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/cmake/leaks_of_libraries.txt")
    return()
  endif()
  set(rest "")
  if(ARG_SLOW)
    gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 TEST_FILTER "${ARG_SLOW}" PROPERTIES ${properties} LABELS slow)
    list(APPEND rest ${ARG_SLOW})
  endif()
  if(ARG_ALONE)
    gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 TEST_FILTER "${ARG_ALONE}" PROPERTIES ${properties} RUN_SERIAL ON)
    list(APPEND rest ${ARG_ALONE})
  endif()
  if(rest)
    list(JOIN rest ":" rest)
    set(rest TEST_FILTER "-${rest}")
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 ${rest} PROPERTIES ${properties})
endfunction()

# passo_slow_test(NAME SECONDS COMMAND program [argument…] [ENVIRONMENT name=value…] [IN_FULL name=value…])
#
# Tests of a program that a developer would not wait for. CI runs them with ENVIRONMENT, which asks for a part of
# the trials, in about so many seconds, the longest first, so that no processor stands idle at the end. With
# PASSO_TESTS_IN_FULL they get IN_FULL instead, which asks for all.
function(passo_slow_test name seconds)
  cmake_parse_arguments(ARG "" "" "COMMAND;ENVIRONMENT;IN_FULL" ${ARGN})
  set(timeout 600)
  if(PASSO_TESTS_IN_FULL)
    set(ARG_ENVIRONMENT ${ARG_IN_FULL})
    set(timeout 7200)
  endif()
  add_test(NAME ${name} COMMAND ${ARG_COMMAND})
  set_tests_properties(${name} PROPERTIES
    LABELS slow COST ${seconds} TIMEOUT ${timeout} ENVIRONMENT "${ARG_ENVIRONMENT}")
endfunction()
