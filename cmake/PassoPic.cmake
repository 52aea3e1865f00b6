# Programs for PIC microcontrollers: gpasm, of gputils. PASSO_GPASM tells whether it is here.
find_program(PASSO_GPASM NAMES gpasm)

# passo_pic_program(NAME SOURCE file [DEFINITIONS name=value…])
#
# The target NAME builds NAME.hex, for the programmer, and NAME.cod, for gpsim, in the current binary directory; the path of
# the latter is the target's property PASSO_COD. The source names its chip.
function(passo_pic_program name)
  cmake_parse_arguments(ARG "" "SOURCE" "DEFINITIONS" ${ARGN})
  list(TRANSFORM ARG_DEFINITIONS PREPEND "-D")
  set(source "${CMAKE_CURRENT_SOURCE_DIR}/${ARG_SOURCE}")
  set(hex "${CMAKE_CURRENT_BINARY_DIR}/${name}.hex")
  set(cod "${CMAKE_CURRENT_BINARY_DIR}/${name}.cod")
  # -w 1: without the messages that there are banks. The .cod names its source and itself as they are named here: without the
  # folder of the checkout.
  file(RELATIVE_PATH source_from_here "${CMAKE_CURRENT_BINARY_DIR}" "${source}")
  add_custom_command(OUTPUT "${hex}" "${cod}"
    COMMAND "${PASSO_GPASM}" -w 1 ${ARG_DEFINITIONS} -o "${name}.hex" "${source_from_here}"
    WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}"
    DEPENDS "${source}" COMMENT "Assembling ${ARG_SOURCE}" VERBATIM)
  add_custom_target(${name} DEPENDS "${hex}")
  set_target_properties(${name} PROPERTIES PASSO_COD "${cod}")
endfunction()
