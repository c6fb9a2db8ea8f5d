# Placeholder bodies are filled in with the GPU core.
function(lightwell_kernels target folder)
endfunction()
function(lightwell_technique_table target folder)
endfunction()
