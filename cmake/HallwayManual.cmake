# SPDX-License-Identifier: MIT
# hallway_install_manual(<program>): installs the program's manual pages and its completions for bash, zsh and fish. The program makes them itself, so
# a cross build that cannot run it has none.
function(hallway_install_manual program)
  if(HALLWAY_SANITIZE OR (CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR))
    return()
  endif()
  set(folder ${CMAKE_BINARY_DIR}/manual/${program})
  add_custom_command(
    OUTPUT ${folder}/stamp
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${folder}
    COMMAND ${program} man --out ${folder}/man1
    COMMAND ${program} completion bash > ${folder}/${program}
    COMMAND ${program} completion zsh > ${folder}/_${program}
    COMMAND ${program} completion fish > ${folder}/${program}.fish
    COMMAND ${CMAKE_COMMAND} -E touch ${folder}/stamp
    DEPENDS ${program}
    COMMENT "Manual pages and completions of ${program}"
    VERBATIM)
  add_custom_target(${program}_manual ALL DEPENDS ${folder}/stamp)
  install(DIRECTORY ${folder}/man1 DESTINATION share/man)
  install(FILES ${folder}/${program} DESTINATION share/bash-completion/completions)
  install(FILES ${folder}/_${program} DESTINATION share/zsh/site-functions)
  install(FILES ${folder}/${program}.fish DESTINATION share/fish/vendor_completions.d)
endfunction()
