# SPDX-License-Identifier: Apache-2.0
# cmake -DOUTPUT=presets.cpp -DFOLDER=resources/presets -P embed_presets.cmake
# Writes all presets as string literals, so that programs need no files beside them.
file(GLOB presets ${FOLDER}/*.json)
list(SORT presets)
set(text "// Generated from resources/presets by cmake/embed_presets.cmake.\n")
string(APPEND text "#include <string_view>\n#include <utility>\n#include <vector>\n\nnamespace whorl {\n\n")
string(APPEND text "std::vector<std::pair<std::string_view, std::string_view>> embeddedPresets();\n")
string(APPEND text "std::vector<std::pair<std::string_view, std::string_view>> embeddedPresets() {\n    return {\n")
foreach(preset ${presets})
    get_filename_component(name ${preset} NAME_WE)
    file(READ ${preset} source)
    string(APPEND text "        {\"${name}\", R\"__json__(${source})__json__\"},\n")
endforeach()
string(APPEND text "    };\n}\n\n}  // namespace whorl\n")
file(WRITE ${OUTPUT} "${text}")
