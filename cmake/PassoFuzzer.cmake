# passo_fuzzer(<name> SOURCES … CORPUS <folder> MODULES … LIBRARIES …)
#
# Always: the test <name>_replay, which feeds the corpus to the fuzzer's function, with any compiler.
# With PASSO_FUZZ=ON (clang only): the libFuzzer executable <name>. The sources of the modules under test are compiled a
# second time, once for all fuzzers, since they steer by instrumented branches.
option(PASSO_FUZZ "Build the fuzzers (clang only)" OFF)

function(passo_fuzzer name)
  cmake_parse_arguments(ARG "" "CORPUS" "SOURCES;MODULES;LIBRARIES" ${ARGN})
  if(PASSO_BUILD_TESTS)
    list(TRANSFORM ARG_MODULES PREPEND "passo_" OUTPUT_VARIABLE libraries)
    passo_test(${name}_replay SOURCES ${ARG_SOURCES} "${PROJECT_SOURCE_DIR}/tests/kit/corpus_replay.cpp"
      LIBRARIES ${libraries} ${ARG_LIBRARIES}
      DEFINITIONS PASSO_FUZZER="${name}" PASSO_CORPUS="${CMAKE_CURRENT_SOURCE_DIR}/${ARG_CORPUS}")
  endif()
  if(NOT PASSO_FUZZ)
    return()
  endif()
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "PASSO_FUZZ needs clang: libFuzzer is a part of it")
  endif()
  # Optimised: a fuzzer is as good as it is fast.
  set(instrumented -O1 -UNDEBUG -g -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all)
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  foreach(module IN LISTS ARG_MODULES)
    if(NOT TARGET passo_${module}_fuzzed)
      get_target_property(sources passo_${module} SOURCES)
      list(TRANSFORM sources PREPEND "${PASSO_FOLDER_${module}}/")
      add_library(passo_${module}_fuzzed OBJECT ${sources})
      target_include_directories(passo_${module}_fuzzed PUBLIC "${PASSO_FOLDER_${module}}/include")
      target_include_directories(passo_${module}_fuzzed PRIVATE $<TARGET_PROPERTY:passo_${module},INCLUDE_DIRECTORIES>)
      target_compile_definitions(passo_${module}_fuzzed PRIVATE $<TARGET_PROPERTY:passo_${module},COMPILE_DEFINITIONS>)
      target_link_libraries(passo_${module}_fuzzed PUBLIC ${ARG_LIBRARIES} passo_compiler)
      target_compile_options(passo_${module}_fuzzed PRIVATE ${instrumented})
    endif()
    target_link_libraries(${name} PRIVATE passo_${module}_fuzzed)
  endforeach()
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} passo_compiler)
  target_compile_options(${name} PRIVATE ${instrumented})
  target_link_options(${name} PRIVATE -fsanitize=fuzzer,address,undefined)
endfunction()
