# passo_loads_late(TARGET DEFINITION LIBRARY): the sources of TARGET open LIBRARY (a file) where they need it, by the name
# that the library itself states. DEFINITION is that name as a string. docs/decisions/0120
function(passo_loads_late target definition library)
  execute_process(COMMAND "${CMAKE_READELF}" -d "${library}" OUTPUT_VARIABLE dynamic)
  if(NOT dynamic MATCHES "SONAME[^\\[]*\\[([^]]+)\\]")
    message(FATAL_ERROR "${library} has no name to be loaded by")
  endif()
  target_compile_definitions(${target} PRIVATE "${definition}=\"${CMAKE_MATCH_1}\"")
  target_link_libraries(${target} PRIVATE ${CMAKE_DL_LIBS})
endfunction()
