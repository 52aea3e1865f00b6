# Programs for the chip: clang compiles C++20 for the AVR, avr-gcc links it with avr-libc's start-up code and libgcc.
# Why these two: docs/decisions/0040-clang-compiles-for-the-chip.md.
#
# PASSO_AVR_FOUND tells whether both are here; PASSO_AVR_COMPILER names them, for figures that depend on them.
find_program(PASSO_CLANG NAMES clang++ clang++-14)
find_program(PASSO_AVR_GCC NAMES avr-gcc)
find_program(PASSO_AVR_OBJCOPY NAMES avr-objcopy)
set(PASSO_AVR_FOUND OFF)
if(PASSO_CLANG AND PASSO_AVR_GCC AND PASSO_AVR_OBJCOPY)
  # clang's own <stdint.h>, and nothing of the host's.
  execute_process(COMMAND "${PASSO_CLANG}" -print-resource-dir
    OUTPUT_VARIABLE PASSO_CLANG_RESOURCES OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND "${PASSO_CLANG}" --target=avr -mmcu=atmega328p -fsyntax-only -x c++ /dev/null
    RESULT_VARIABLE PASSO_CLANG_KNOWS_NO_AVR OUTPUT_QUIET ERROR_QUIET)
  if(NOT PASSO_CLANG_KNOWS_NO_AVR)
    set(PASSO_AVR_FOUND ON)
    execute_process(COMMAND "${PASSO_CLANG}" -dumpversion OUTPUT_VARIABLE clang_version OUTPUT_STRIP_TRAILING_WHITESPACE)
    execute_process(COMMAND "${PASSO_AVR_GCC}" -dumpversion OUTPUT_VARIABLE gcc_version OUTPUT_STRIP_TRAILING_WHITESPACE)
    set(PASSO_AVR_COMPILER "clang ${clang_version} with the libgcc of avr-gcc ${gcc_version}")
  endif()
endif()

set(PASSO_AVR_OPTIONS
  --target=avr -std=c++20 -O2 -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics
  -Wall -Wextra -Wshadow
  -nostdinc -isystem "${PASSO_CLANG_RESOURCES}/include"
  # LLVM turns `if` into a choice between two values, which an AVR has to make with branches and copies. Leave the `if`.
  -mllvm -two-entry-phi-node-folding-threshold=1)

# passo_avr_program(NAME MCU mcu SOURCES file… [MODULES module…] [INCLUDES directory…] [OPTIONS option…] [DATA address]
#                   [LINK_OPTIONS option…])
#
# The target NAME builds NAME.elf in the current binary directory; its path is the target's property PASSO_ELF. MODULES are
# the portable modules whose headers the sources include; INCLUDES are further places to look for headers. DATA is where the
# linker may begin to place variables, for programs that have laid out the RAM below themselves. NAME.hex beside it is for
# avrdude.
function(passo_avr_program name)
  cmake_parse_arguments(ARG "" "MCU;DATA" "SOURCES;MODULES;INCLUDES;OPTIONS;LINK_OPTIONS" ${ARGN})
  set(options ${PASSO_AVR_OPTIONS} -mmcu=${ARG_MCU} -DPASSO_FIRMWARE_VERSION=${PASSO_FIRMWARE_VERSION} ${ARG_OPTIONS})
  set(link_options -mmcu=${ARG_MCU} ${ARG_LINK_OPTIONS})
  if(ARG_DATA)
    list(APPEND link_options "-Wl,--section-start=.data=${ARG_DATA}")
  endif()
  foreach(module IN LISTS ARG_MODULES)
    list(APPEND options "-I${PASSO_FOLDER_${module}}/include")
  endforeach()
  foreach(directory IN LISTS ARG_INCLUDES)
    list(APPEND options "-I${directory}")
  endforeach()
  if(PASSO_WERROR)
    list(APPEND options -Werror)
  endif()

  foreach(source IN LISTS ARG_SOURCES)
    cmake_path(GET source STEM stem)
    set(object "${CMAKE_CURRENT_BINARY_DIR}/${name}.dir/${stem}.o")
    add_custom_command(OUTPUT "${object}"
      COMMAND "${CMAKE_COMMAND}" -E make_directory "${CMAKE_CURRENT_BINARY_DIR}/${name}.dir"
      COMMAND "${PASSO_CLANG}" ${options} -MD -MF "${object}.d" -MT "${object}"
              -c "${CMAKE_CURRENT_SOURCE_DIR}/${source}" -o "${object}"
      DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${source}" DEPFILE "${object}.d"
      COMMENT "Compiling ${source} for ${ARG_MCU}" VERBATIM)
    list(APPEND objects "${object}")
  endforeach()

  set(elf "${CMAKE_CURRENT_BINARY_DIR}/${name}.elf")
  set(hex "${CMAKE_CURRENT_BINARY_DIR}/${name}.hex")
  add_custom_command(OUTPUT "${elf}" "${hex}"
    COMMAND "${PASSO_AVR_GCC}" ${link_options} ${objects} -o "${elf}"
    COMMAND "${PASSO_AVR_OBJCOPY}" -O ihex "${elf}" "${hex}"
    DEPENDS ${objects} COMMENT "Linking ${name}.elf" VERBATIM)
  add_custom_target(${name} DEPENDS "${elf}")
  set_target_properties(${name} PROPERTIES PASSO_ELF "${elf}")
endfunction()
