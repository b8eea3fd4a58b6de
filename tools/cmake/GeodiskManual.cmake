# geodisk_install_manual(TARGET COMPONENT): installs manual pages and the completion of shells, which a
# program writes itself.
function(geodisk_install_manual target component)
    get_target_property(name ${target} OUTPUT_NAME)
    set(folder "${CMAKE_CURRENT_BINARY_DIR}/manual/${name}")
    set(program "$<TARGET_FILE:${target}>")
    file(MAKE_DIRECTORY "${folder}/man1")
    add_custom_command(
        OUTPUT "${folder}/${name}" "${folder}/_${name}" "${folder}/man1/${name}.1"
        COMMAND "${program}" manual --output "${folder}/man1"
        COMMAND "${program}" completion bash > "${folder}/${name}"
        COMMAND "${program}" completion zsh > "${folder}/_${name}"
        DEPENDS ${target}
        COMMENT "Writing manual pages of ${name}"
        VERBATIM)
    add_custom_target(${name}_manual ALL DEPENDS "${folder}/man1/${name}.1")
    install(DIRECTORY "${folder}/man1" DESTINATION "${CMAKE_INSTALL_MANDIR}" COMPONENT ${component})
    install(FILES "${folder}/${name}"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" COMPONENT ${component})
    # Where zsh of Debian looks for what packages bring, else its own folder.
    install(FILES "${folder}/_${name}"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/$<IF:$<BOOL:${GEODISK_DEB}>,vendor-completions,site-functions>"
        COMPONENT ${component})
endfunction()
