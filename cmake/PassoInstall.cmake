# What is installed, and where: docs/manual/installing.md. `passo` and the emulators, which are linked with libraries under the
# GPL, are separate components. Targets and files that this build cannot make are left out.
#
# passo_install(): called after all modules.
function(passo_install)
  set(share "${CMAKE_INSTALL_DATADIR}/passo")
  set(libexec "${CMAKE_INSTALL_LIBEXECDIR}/passo")
  set(chip "${PASSO_FOLDER_chip}")
  cmake_path(RELATIVE_PATH chip BASE_DIRECTORY "${PROJECT_SOURCE_DIR}")
  set(images "${PROJECT_BINARY_DIR}/${chip}")

  install(TARGETS passo RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT passo)
  # The web interface, as built by scripts/page.sh.
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/build/page" DESTINATION "${share}" COMPONENT passo OPTIONAL)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/examples" DESTINATION "${share}" COMPONENT passo)
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT passo)

  # What a board is flashed with; and what an emulated chip runs, beside its emulator.
  foreach(board IN ITEMS uno mega)
    foreach(program IN ITEMS motion motion_two_on motion_wave motion_half_step follower_two_on follower_wave follower_half_step)
      string(REGEX REPLACE "^([a-z]+)" "\\1_${board}" image "${program}")
      if(TARGET ${image})
        install(FILES "${images}/${image}.hex" DESTINATION "${share}/firmware" COMPONENT passo)
        install(FILES "${images}/${image}.elf" DESTINATION "${libexec}/firmware" COMPONENT emulators)
        list(APPEND made ${image})
      endif()
    endforeach()
  endforeach()
  foreach(board IN ITEMS pico pico_lathe pico_mpg pico_eight picobob)
    if(TARGET motion_${board})
      install(FILES "${images}/motion_${board}.uf2" DESTINATION "${share}/firmware" COMPONENT passo)
      list(APPEND made motion_${board})
    endif()
  endforeach()
  foreach(image IN ITEMS follower_pic_two_on follower_pic_wave follower_pic_half_step first_board)
    if(TARGET ${image})
      install(FILES "${images}/${image}.cod" DESTINATION "${libexec}/firmware" COMPONENT emulators)
      list(APPEND made ${image})
    endif()
  endforeach()

  # Manual pages and shell completion, by the program itself.
  set(documents "${PROJECT_BINARY_DIR}/documents")
  add_custom_command(OUTPUT "${documents}/made"
    COMMAND passo documents "${documents}" COMMAND "${CMAKE_COMMAND}" -E touch "${documents}/made"
    DEPENDS passo COMMENT "Writing manual pages and shell completion" VERBATIM)
  if(PASSO_SANITIZE)
    add_custom_target(command_documents DEPENDS "${documents}/made")
  else()
    add_custom_target(command_documents ALL DEPENDS "${documents}/made")
  endif()
  install(DIRECTORY "${documents}/man1" DESTINATION "${CMAKE_INSTALL_MANDIR}" COMPONENT passo)
  install(FILES "${documents}/completion/passo"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" COMPONENT passo)
  install(FILES "${documents}/completion/_passo" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/site-functions" COMPONENT passo)
  install(FILES "${documents}/completion/passo.fish"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d" COMPONENT passo)

  install(FILES "${PROJECT_SOURCE_DIR}/page/public/icon.svg"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps" COMPONENT passo RENAME passo.svg)

  # All that `cmake --install` needs, except the web interface.
  add_custom_target(everything_installed DEPENDS passo command_documents ${made})
  foreach(target IN ITEMS passo_emulate_avr passo_shared passo_python)
    if(TARGET ${target})
      add_dependencies(everything_installed ${target})
    endif()
  endforeach()
endfunction()
