# embed_kernels(OUTPUT FOLDER FILES): writes a C++ file that holds the text of every kernel source, by relative name.
# It is written anew at build time whenever one of them changes.
function(embed_kernels output folder files)
    set(paths "")
    foreach(file IN LISTS files)
        list(APPEND paths ${folder}/${file})
    endforeach()
    string(REPLACE ";" "," joined "${files}")
    add_custom_command(OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DFOLDER=${folder} -DFILES=${joined}
                -P ${CMAKE_CURRENT_SOURCE_DIR}/cmake/WriteKernelSources.cmake
        DEPENDS ${paths} ${CMAKE_CURRENT_SOURCE_DIR}/cmake/WriteKernelSources.cmake
        COMMENT "Embedding kernel sources" VERBATIM)
endfunction()
