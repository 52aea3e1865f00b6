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

# fmt and the header libraries of machine files and JSON, and nothing else of the host's headers.
if(PASSO_WASM_FOUND)
  file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/wasm_include")
  file(CREATE_LINK "${PASSO_FMT_INCLUDE}/fmt" "${PROJECT_BINARY_DIR}/wasm_include/fmt" SYMBOLIC)
  find_path(PASSO_TOML_INCLUDE toml++/toml.h)
  find_path(PASSO_JSON_INCLUDE nlohmann/json.hpp)
  foreach(library IN ITEMS TOML_INCLUDE/toml++ JSON_INCLUDE/nlohmann)
    string(REGEX MATCH "^[^/]+" path "${library}")
    string(REGEX REPLACE "^[^/]+/" "" folder "${library}")
    if(PASSO_${path})
      file(CREATE_LINK "${PASSO_${path}}/${folder}" "${PROJECT_BINARY_DIR}/wasm_include/${folder}" SYMBOLIC)
    endif()
  endforeach()
endif()

# -Os: what is sent to a browser counts. The sweep of the stock takes 9 % longer than with -O2.
set(PASSO_WASM_OPTIONS
  --target=wasm32-wasi -std=c++20 -Os -fno-exceptions -fno-rtti -fno-threadsafe-statics
  -ffunction-sections -fdata-sections -Wall -Wextra -Wconversion
  "-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=" "-ffile-prefix-map=${PROJECT_BINARY_DIR}/="
  -DFMT_HEADER_ONLY=1 -DTOML_EXCEPTIONS=0 -DJSON_HAS_FILESYSTEM=0 -isystem "${PROJECT_BINARY_DIR}/wasm_include")

set(PASSO_WASM_HEADERS "")
foreach(header IN ITEMS algorithm array cmath functional map memory optional span string string_view utility variant vector fmt/format.h)
  string(APPEND PASSO_WASM_HEADERS "#include <${header}>\n")
endforeach()

# passo_wasm_module(NAME SOURCES module/file… [APART module/file…] [TOGETHER module…] [MODULES module…] [OPTIMISED module…]
#                   [MEMORY MiB])
#
# The target NAME builds NAME.wasm in the current binary directory; its path is the target's property PASSO_WASM. SOURCES
# begin with their module; those of one module are compiled together, which takes a third of the time, and so are those of
# the modules TOGETHER (of some perhaps only the headers). Those whose own names clash with the others' are APART. MODULES are further modules whose headers
# the sources include. With OPTIMISED, these modules are compiled with -O2 and the others with -O1: what is fetched counts
# less than the time that it computes. MEMORY: the most that the module may take, 256 MiB if not said.
function(passo_wasm_module name)
  cmake_parse_arguments(ARG "" "MEMORY" "SOURCES;APART;TOGETHER;MODULES;OPTIMISED" ${ARGN})
  set(options ${PASSO_WASM_OPTIONS})
  if(NOT ARG_MEMORY)
    set(ARG_MEMORY 256)
  endif()
  set(modules ${ARG_SOURCES} ${ARG_APART})
  list(TRANSFORM modules REPLACE "/.*" "")
  list(REMOVE_DUPLICATES modules)
  foreach(module IN LISTS modules ARG_MODULES)
    list(APPEND options "-I${PASSO_FOLDER_${module}}/include")
  endforeach()
  if(PASSO_WERROR)
    list(APPEND options -Werror)
  endif()
  # The headers that most sources include, compiled once: a unit takes a quarter less time.
  set(headers "${CMAKE_CURRENT_BINARY_DIR}/${name}.dir/headers")
  file(CONFIGURE OUTPUT "${headers}.hpp" CONTENT "${PASSO_WASM_HEADERS}" @ONLY)
  list(APPEND options -Xclang -fno-pch-timestamp)
  set(headers_options ${options})
  if(ARG_OPTIMISED)
    list(APPEND headers_options -O1)
  endif()
  add_custom_command(OUTPUT "${headers}.pch"
    COMMAND ${CMAKE_CXX_COMPILER_LAUNCHER} "${PASSO_CLANG}" ${headers_options} -MD -MF "${headers}.d" -MT "${headers}.pch"
            -x c++-header "${headers}.hpp" -o "${headers}.pch"
    DEPENDS "${headers}.hpp" DEPFILE "${headers}.d" COMMENT "Compiling headers for WebAssembly" VERBATIM)
  list(APPEND options -include-pch "${headers}.pch")
  # A unit has the name of its module, or of the source that stands apart, or "together".
  set(units ${modules} ${ARG_APART})
  if(ARG_TOGETHER)
    list(REMOVE_ITEM units ${ARG_TOGETHER})
    list(APPEND units together)
  endif()
  foreach(unit IN LISTS units)
    string(REGEX REPLACE "/.*" "" of_unit "${unit}")
    set(sources "${unit}")
    if(unit STREQUAL "together")
      set(of_unit ${ARG_TOGETHER})
    endif()
    if(NOT unit MATCHES "/")
      list(JOIN of_unit "|" any)
      set(sources ${ARG_SOURCES})
      list(FILTER sources INCLUDE REGEX "^(${any})/")
    endif()
    if(NOT sources)
      continue()
    endif()
    set(own "")
    foreach(module IN LISTS of_unit)
      list(TRANSFORM sources REPLACE "^${module}/" "${PASSO_FOLDER_${module}}/")
      list(APPEND own "-I${PASSO_FOLDER_${module}}")
      if(NOT module IN_LIST modules)
        list(APPEND own "-I${PASSO_FOLDER_${module}}/include")
      endif()
    endforeach()
    if(ARG_OPTIMISED)
      set(level -O1)
      if(of_unit IN_LIST ARG_OPTIMISED)
        set(level -O2)
      endif()
      list(APPEND own ${level})
    endif()
    list(TRANSFORM sources REPLACE "(.+)" "#include \"\\1\"\n" OUTPUT_VARIABLE lines)
    string(JOIN "" text ${lines})
    string(REGEX REPLACE "[/.]" "_" unit "${unit}")
    set(unit "${CMAKE_CURRENT_BINARY_DIR}/${name}.dir/${unit}")
    file(CONFIGURE OUTPUT "${unit}.cpp" CONTENT "${text}" @ONLY)
    add_custom_command(OUTPUT "${unit}.o"
      COMMAND ${CMAKE_CXX_COMPILER_LAUNCHER} "${PASSO_CLANG}" ${options} ${own}
              -MD -MF "${unit}.d" -MT "${unit}.o" -c "${unit}.cpp" -o "${unit}.o"
      DEPENDS "${unit}.cpp" "${headers}.pch" ${sources} DEPFILE "${unit}.d" COMMENT "Compiling ${of_unit} for WebAssembly" VERBATIM)
    list(APPEND objects "${unit}.o")
  endforeach()
  math(EXPR memory "${ARG_MEMORY} * 1024 * 1024")
  set(wasm "${CMAKE_CURRENT_BINARY_DIR}/${name}.wasm")
  add_custom_command(OUTPUT "${wasm}"
    COMMAND "${PASSO_CLANG}" --target=wasm32-wasi -mexec-model=reactor -Wl,--gc-sections -Wl,--strip-all
            -Wl,--max-memory=${memory} ${objects} -o "${wasm}"
    DEPENDS ${objects} COMMENT "Linking ${name}.wasm" VERBATIM)
  add_custom_target(${name} ALL DEPENDS "${wasm}")
  set_target_properties(${name} PROPERTIES PASSO_WASM "${wasm}")
endfunction()
