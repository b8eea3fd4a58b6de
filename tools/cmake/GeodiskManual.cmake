# geodisk_install_manual(): installs manual pages and the completion of shells, which the program
# writes itself.
function(geodisk_install_manual)
    set(folder "${CMAKE_CURRENT_BINARY_DIR}/manual")
    set(geodisk "$<TARGET_FILE:geodisk_cli>")
    file(MAKE_DIRECTORY "${folder}/man1")
    add_custom_command(
        OUTPUT "${folder}/geodisk" "${folder}/_geodisk" "${folder}/man1/geodisk.1"
        COMMAND "${geodisk}" manual --output "${folder}/man1"
        COMMAND "${geodisk}" completion bash > "${folder}/geodisk"
        COMMAND "${geodisk}" completion zsh > "${folder}/_geodisk"
        DEPENDS geodisk_cli
        COMMENT "Writing manual pages"
        VERBATIM)
    add_custom_target(geodisk_manual ALL DEPENDS "${folder}/man1/geodisk.1")
    install(DIRECTORY "${folder}/man1" DESTINATION "${CMAKE_INSTALL_MANDIR}" COMPONENT program)
    install(FILES "${folder}/geodisk"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" COMPONENT program)
    # Where zsh of Debian looks for what packages bring, else its own folder.
    install(FILES "${folder}/_geodisk"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/$<IF:$<BOOL:${GEODISK_DEB}>,vendor-completions,site-functions>"
        COMPONENT program)
endfunction()
