# One compiler setting for the whole house.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

option(PASSO_WERROR "Treat warnings as errors" OFF)
option(PASSO_SANITIZE "Build with AddressSanitizer and UndefinedBehaviorSanitizer" OFF)

add_library(passo_compiler INTERFACE)
target_compile_options(passo_compiler INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wold-style-cast -Wnon-virtual-dtor -Wcast-qual
  # Nobody reads errno after a root. Without it a root is one instruction, and loops with roots become vectors.
  -fno-math-errno
  # The same program gives the same bytes on every compiler: no fused multiply-add behind our back.
  -ffp-contract=off)
# Where g++ compiles the program, clang may compile the tests: passo_by_clang().
define_property(TARGET PROPERTY PASSO_BY_CLANG BRIEF_DOCS "clang compiles it, whatever compiles the rest")
set(by_gcc "$<AND:$<CXX_COMPILER_ID:GNU>,$<NOT:$<BOOL:$<TARGET_PROPERTY:PASSO_BY_CLANG>>>>")
# g++ 12 finds overlapping copies in std::string where there are none (GCC bug 105651).
target_compile_options(passo_compiler INTERFACE $<${by_gcc}:-Wno-restrict>)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
  # g++ notes at each pair of numbers that its calls changed in version 10.
  target_compile_options(passo_compiler INTERFACE $<${by_gcc}:-Wno-psabi>)
endif()
if(PASSO_WERROR)
  target_compile_options(passo_compiler INTERFACE -Werror)
endif()
if(PASSO_SANITIZE)
  target_compile_options(passo_compiler INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(passo_compiler INTERFACE -fsanitize=address,undefined)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Its instrumentation hides from g++ 12 that std::regex sets what it uses.
    target_compile_options(passo_compiler INTERFACE -Wno-maybe-uninitialized)
  endif()
endif()

find_program(PASSO_CCACHE ccache)
if(PASSO_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Precompiled headers are kept too; for g++ that takes an option more. The cache reads the compiler's own list of
  # headers, so that a source that it does not know is not preprocessed first.
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_DEPEND=1
    "${PASSO_CCACHE}")
  # What clang's cache returns was compiled from another file of the same contents.
  target_compile_options(passo_compiler INTERFACE $<IF:${by_gcc},-fpch-preprocess,SHELL:-Xclang -fno-pch-timestamp>)
endif()

# clang compiles tests in less than half of g++'s time. g++ compiles them where they make all of their trials
# (scripts/test.sh --full), and where there is no clang: decision 0183.
find_program(PASSO_CLANG NAMES clang++ clang++-14)
function(passo_by_clang target)
  if(NOT PASSO_CLANG OR NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU" OR NOT PASSO_TOGETHER OR PASSO_TESTS_IN_FULL)
    return()
  endif()
  set(launcher "${PROJECT_SOURCE_DIR}/cmake/compile_by.sh" "${CMAKE_CXX_COMPILER}" "${PASSO_CLANG}"
    ${CMAKE_CXX_COMPILER_LAUNCHER})
  set_target_properties(${target} PROPERTIES PASSO_BY_CLANG ON CXX_COMPILER_LAUNCHER "${launcher}")
endfunction()

# lld, which is here for WebAssembly, links three times as fast as ld. A cross compiler does not find it.
find_program(PASSO_LLD NAMES ld.lld ld.lld-14)
if(PASSO_LLD AND NOT CMAKE_CROSSCOMPILING)
  add_link_options(-fuse-ld=lld)
endif()
