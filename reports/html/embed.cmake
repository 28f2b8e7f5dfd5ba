# Writes report.css and report.js into a C++ file, with the hashes that the Content-Security-Policy of a report names:
#   cmake -DCSS=report.css -DJS=report.js -DOUTPUT=report_assets.cc -P embed.cmake

# The SHA-256 of a text as a policy wants it: base64.
function(base64_sha256 text result)
  set(alphabet ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/)
  string(SHA256 digest "${text}")
  string(APPEND digest 00)  # 32 bytes are ten groups of three and one of two
  set(out "")
  foreach(at RANGE 0 60 6)
    string(SUBSTRING ${digest} ${at} 6 group)
    foreach(shift 18 12 6 0)
      math(EXPR index "(0x${group} >> ${shift}) & 63")
      string(SUBSTRING ${alphabet} ${index} 1 letter)
      string(APPEND out ${letter})
    endforeach()
  endforeach()
  string(SUBSTRING ${out} 0 43 out)
  set(${result} "${out}=" PARENT_SCOPE)
endfunction()

file(READ ${CSS} css)
file(READ ${JS} js)
if(css MATCHES "</" OR js MATCHES "</")
  message(FATAL_ERROR "'</' in report.css or report.js would end the element that holds it")
endif()
# The marks let the page be read as XML as well: "<" and "&" of the script are then no markup.
set(css "/*<![CDATA[*/\n${css}/*]]>*/")
set(js "//<![CDATA[\n${js}//]]>")
base64_sha256("${css}" css_hash)
base64_sha256("${js}" js_hash)
file(WRITE ${OUTPUT} "// SPDX-License-Identifier: Apache-2.0
// Made by reports/html/embed.cmake.
#include \"reports/html/assets.hpp\"

namespace conform::reports::html {

const std::string_view style_text = R\"~~~(${css})~~~\";
const std::string_view style_hash = \"${css_hash}\";
const std::string_view script_text = R\"~~~(${js})~~~\";
const std::string_view script_hash = \"${js_hash}\";

}  // namespace conform::reports::html
")
