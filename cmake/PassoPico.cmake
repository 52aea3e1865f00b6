# Programs for the RP2040: clang compiles C++20 for the Cortex-M0+, lld links it. Why these two: they are 5 MB beside the
# clang that compiles for the AVR; gcc-arm-none-eabi with its newlib would be 800 MB, and nothing of it is needed.
#
# PASSO_PICO_FOUND tells whether both are here.
find_program(PASSO_CLANG NAMES clang++ clang++-14)
find_program(PASSO_LLD NAMES ld.lld ld.lld-14)
set(PASSO_PICO_FOUND OFF)
if(PASSO_CLANG AND PASSO_LLD)
  execute_process(COMMAND "${PASSO_CLANG}" --target=thumbv6m-none-eabi -ffreestanding -fsyntax-only -x c++ /dev/null
    RESULT_VARIABLE PASSO_CLANG_KNOWS_NO_ARM OUTPUT_QUIET ERROR_QUIET)
  if(NOT PASSO_CLANG_KNOWS_NO_ARM)
    set(PASSO_PICO_FOUND ON)
  endif()
endif()
if(PASSO_PICO_FOUND)
  execute_process(COMMAND "${PASSO_CLANG}" -print-resource-dir
    OUTPUT_VARIABLE PASSO_PICO_RESOURCES OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
else()
  message(STATUS "clang++ with ARM or ld.lld not found: no firmware for the Pico")
endif()

set(PASSO_PICO_OPTIONS
  --target=thumbv6m-none-eabi -mcpu=cortex-m0plus -mthumb -O2 -ffreestanding
  -ffunction-sections -fdata-sections -Wall -Wextra -Wshadow
  -nostdinc -isystem "${PASSO_PICO_RESOURCES}/include")
set(PASSO_PICO_CXX_OPTIONS -std=c++20 -fno-exceptions -fno-rtti -fno-threadsafe-statics)

# passo_pico_program(NAME SOURCES file… MODULES module… SCRIPT linker-script [OPTIONS option…])
#
# The target NAME builds NAME.elf and NAME.uf2 in the current binary directory; the path of the latter is the target's
# property PASSO_UF2. MODULES are the portable modules whose headers the sources include.
function(passo_pico_program name)
  cmake_parse_arguments(ARG "" "SCRIPT" "SOURCES;MODULES;OPTIONS" ${ARGN})
  set(options ${PASSO_PICO_OPTIONS} -DPASSO_FIRMWARE_VERSION=${PASSO_FIRMWARE_VERSION} ${ARG_OPTIONS})
  foreach(module IN LISTS ARG_MODULES)
    list(APPEND options "-I${PASSO_FOLDER_${module}}/include")
  endforeach()
  if(PASSO_WERROR)
    list(APPEND options -Werror)
  endif()
  foreach(source IN LISTS ARG_SOURCES)
    cmake_path(GET source STEM stem)
    cmake_path(GET source EXTENSION LAST_ONLY extension)
    set(language_options)
    if(extension STREQUAL ".cpp")
      set(language_options ${PASSO_PICO_CXX_OPTIONS})
    endif()
    set(object "${CMAKE_CURRENT_BINARY_DIR}/${name}.dir/${stem}.o")
    add_custom_command(OUTPUT "${object}"
      COMMAND "${CMAKE_COMMAND}" -E make_directory "${CMAKE_CURRENT_BINARY_DIR}/${name}.dir"
      COMMAND "${PASSO_CLANG}" ${options} ${language_options} -MD -MF "${object}.d" -MT "${object}"
              -c "${CMAKE_CURRENT_SOURCE_DIR}/${source}" -o "${object}"
      DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${source}" DEPFILE "${object}.d"
      COMMENT "Compiling ${source} for the RP2040" VERBATIM)
    list(APPEND objects "${object}")
  endforeach()
  set(elf "${CMAKE_CURRENT_BINARY_DIR}/${name}.elf")
  set(uf2 "${CMAKE_CURRENT_BINARY_DIR}/${name}.uf2")
  set(script "${CMAKE_CURRENT_SOURCE_DIR}/${ARG_SCRIPT}")
  add_custom_command(OUTPUT "${elf}" "${uf2}"
    COMMAND "${PASSO_LLD}" -T "${script}" --gc-sections --fatal-warnings ${objects} -o "${elf}"
    COMMAND write_uf2 "${elf}" "${uf2}"
    DEPENDS ${objects} "${script}" write_uf2 COMMENT "Linking ${name}.uf2" VERBATIM)
  add_custom_target(${name} DEPENDS "${uf2}")
  set_target_properties(${name} PROPERTIES PASSO_UF2 "${uf2}")
endfunction()
