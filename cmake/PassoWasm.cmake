# Modules of WebAssembly for the page: clang compiles the program's own sources against Debian's libc++ for WASI, wasm-ld
# links them. Why: docs/decisions/0100-the-core-itself-runs-in-the-browser.md.
#
# PASSO_WASM_FOUND tells whether all parts are here.
find_program(PASSO_CLANG NAMES clang++ clang++-14)
find_program(PASSO_WASM_LD NAMES wasm-ld wasm-ld-14)
find_path(PASSO_FMT_INCLUDE fmt/format.h)
set(PASSO_WASM_FOUND OFF)
if(PASSO_CLANG AND PASSO_WASM_LD AND PASSO_FMT_INCLUDE)
  # As a whole: the compiler's target, libc++, the C library, and the compiler's own functions.
  set(probe "${PROJECT_BINARY_DIR}/wasm_probe")
  file(CONFIGURE OUTPUT "${probe}.cpp" CONTENT "#include <string>\nint length(int n) { return (int)std::to_string(n).size(); }\n")
  execute_process(
    COMMAND "${PASSO_CLANG}" --target=wasm32-wasi -mexec-model=reactor -std=c++20 -fno-exceptions "${probe}.cpp" -o "${probe}.wasm"
    RESULT_VARIABLE PASSO_NO_WASM OUTPUT_QUIET ERROR_QUIET)
  if(NOT PASSO_NO_WASM)
    set(PASSO_WASM_FOUND ON)
  endif()
endif()
if(NOT PASSO_WASM_FOUND)
  message(STATUS "clang++, wasm-ld or libc++ for WASI not found: no lab.wasm, the page has no lab")
endif()

# fmt alone, and nothing else of the host's headers.
if(PASSO_WASM_FOUND)
  file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/wasm_include")
  file(CREATE_LINK "${PASSO_FMT_INCLUDE}/fmt" "${PROJECT_BINARY_DIR}/wasm_include/fmt" SYMBOLIC)
endif()

# -Os: what is sent to a browser counts. The sweep of the stock takes 9 % longer than with -O2.
set(PASSO_WASM_OPTIONS
  --target=wasm32-wasi -std=c++20 -Os -fno-exceptions -fno-rtti -fno-threadsafe-statics
  -ffunction-sections -fdata-sections -Wall -Wextra -Wconversion -Wshadow
  "-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=" "-ffile-prefix-map=${PROJECT_BINARY_DIR}/="
  -DFMT_HEADER_ONLY=1 -isystem "${PROJECT_BINARY_DIR}/wasm_include")

# passo_wasm_module(NAME SOURCES module/file… [MODULES module…])
#
# The target NAME builds NAME.wasm in the current binary directory; its path is the target's property PASSO_WASM. SOURCES
# begin with their module; those of one module are compiled together, which takes a third of the time. MODULES are further
# modules whose headers the sources include.
function(passo_wasm_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;MODULES" ${ARGN})
  set(options ${PASSO_WASM_OPTIONS})
  list(TRANSFORM ARG_SOURCES REPLACE "/.*" "" OUTPUT_VARIABLE modules)
  list(REMOVE_DUPLICATES modules)
  foreach(module IN LISTS modules ARG_MODULES)
    list(APPEND options "-I${PASSO_FOLDER_${module}}/include")
  endforeach()
  if(PASSO_WERROR)
    list(APPEND options -Werror)
  endif()
  foreach(module IN LISTS modules)
    set(sources ${ARG_SOURCES})
    list(FILTER sources INCLUDE REGEX "^${module}/")
    list(TRANSFORM sources REPLACE "^${module}/" "${PASSO_FOLDER_${module}}/")
    list(TRANSFORM sources REPLACE "(.+)" "#include \"\\1\"\n" OUTPUT_VARIABLE lines)
    string(JOIN "" text ${lines})
    set(unit "${CMAKE_CURRENT_BINARY_DIR}/${name}.dir/${module}")
    file(CONFIGURE OUTPUT "${unit}.cpp" CONTENT "${text}" @ONLY)
    add_custom_command(OUTPUT "${unit}.o"
      COMMAND ${CMAKE_CXX_COMPILER_LAUNCHER} "${PASSO_CLANG}" ${options} "-I${PASSO_FOLDER_${module}}"
              -MD -MF "${unit}.d" -MT "${unit}.o" -c "${unit}.cpp" -o "${unit}.o"
      DEPENDS "${unit}.cpp" ${sources} DEPFILE "${unit}.d" COMMENT "Compiling ${module} for WebAssembly" VERBATIM)
    list(APPEND objects "${unit}.o")
  endforeach()
  set(wasm "${CMAKE_CURRENT_BINARY_DIR}/${name}.wasm")
  add_custom_command(OUTPUT "${wasm}"
    COMMAND "${PASSO_CLANG}" --target=wasm32-wasi -mexec-model=reactor -Wl,--gc-sections -Wl,--strip-all
            -Wl,--max-memory=268435456 ${objects} -o "${wasm}"
    DEPENDS ${objects} COMMENT "Linking ${name}.wasm" VERBATIM)
  add_custom_target(${name} ALL DEPENDS "${wasm}")
  set_target_properties(${name} PROPERTIES PASSO_WASM "${wasm}")
endfunction()
