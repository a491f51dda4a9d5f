# SPDX-License-Identifier: Apache-2.0
# cmake -DOUTPUT=shaders.cpp -DFOLDER=resources/shaders -P embed_shaders.cmake
# Writes all shaders as string literals, so that programs need no files beside them.
file(GLOB shaders ${FOLDER}/*.glsl)
list(SORT shaders)
set(text "// Generated from resources/shaders by cmake/embed_shaders.cmake.\n")
string(APPEND text "#include \"render/gl/program.h\"\n\nnamespace whorl::gl {\n\n")
string(APPEND text "std::string_view shaderText(std::string_view name) {\n")
foreach(shader ${shaders})
    get_filename_component(name ${shader} NAME)
    file(READ ${shader} source)
    string(APPEND text "    if (name == \"${name}\") return R\"__glsl__(${source})__glsl__\";\n")
endforeach()
string(APPEND text "    return {};\n}\n\n}  // namespace whorl::gl\n")
file(WRITE ${OUTPUT} "${text}")
