# embed_texts(OUTPUT FOLDER FILES HEADER FUNCTION): writes a C++ file with the FUNCTION that HEADER declares, which returns the text of each of
# FILES, by its name relative to FOLDER. It is written anew at build time whenever one of them changes.
function(embed_texts output folder files header function)
    set(paths "")
    foreach(file IN LISTS files)
        list(APPEND paths ${folder}/${file})
    endforeach()
    string(REPLACE ";" "," joined "${files}")
    add_custom_command(OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DFOLDER=${folder} -DFILES=${joined} -DHEADER=${header} -DFUNCTION=${function}
                -P ${PROJECT_SOURCE_DIR}/cmake/WriteTexts.cmake
        DEPENDS ${paths} ${PROJECT_SOURCE_DIR}/cmake/WriteTexts.cmake
        COMMENT "Embedding ${folder}" VERBATIM)
endfunction()
