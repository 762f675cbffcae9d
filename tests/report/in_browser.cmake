# Opens the report of a small run in headless Chromium: every figure is there and has a size, no script fails, nothing is fetched.
# cmake -DDYGITA=program -DSOURCE_DIR=folder -DCHROMIUM=browser -P in_browser.cmake

if(NOT CHROMIUM OR NOT EXISTS "${CHROMIUM}")
  message("SKIPPED: no chromium here to open the report in (Debian: apt-get install chromium)")
  return()
endif()
set(out ${CMAKE_CURRENT_BINARY_DIR}/in_browser_out)
file(REMOVE_RECURSE ${out})
execute_process(COMMAND ${DYGITA} run ${SOURCE_DIR}/tests/report/deck.lua --quiet --out ${out} RESULT_VARIABLE code ERROR_VARIABLE error OUTPUT_QUIET)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "dygita run: exit code ${code}\n${error}")
endif()

# The page with a probe that the browser runs: what it finds goes into an attribute of <html>.
set(folder ${out}/page/base)
file(READ ${folder}/report.html page)
set(probe [==[
<script>
window.onerror = (message) => { document.documentElement.dataset.error = message; };
window.onload = () => {
  const size = (e) => e.getBoundingClientRect();
  const figures = [...document.querySelectorAll("figure > svg")];
  const empty = figures.filter(e => size(e).width < 100 || size(e).height < 20 || !e.querySelector("path, rect"));
  const out = [...document.querySelectorAll("figure svg text")].filter(e => size(e).left < size(e.closest("figure > svg")).left - 3 || size(e).right > size(e.closest("figure > svg")).right + 3);
  const found = document.documentElement.dataset;
  found.figures = figures.length;
  found.empty = empty.map(e => e.getAttribute("aria-label")).join("; ");
  found.outside = out.map(e => e.textContent).join("; ");
  found.fetched = performance.getEntriesByType("resource").map(e => e.name).join(" ");
  found.wide = document.documentElement.scrollWidth > document.documentElement.clientWidth ? "yes" : "no";
  found.done = "yes";
};
</script>
</head>]==])
string(REPLACE "</head>" "${probe}" page "${page}")
file(WRITE ${folder}/probed.html "${page}")
execute_process(
  COMMAND ${CHROMIUM} --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --window-size=1200,900 --user-data-dir=${out}/profile
    --virtual-time-budget=5000 --dump-dom file://${folder}/probed.html
  OUTPUT_VARIABLE dom ERROR_VARIABLE log RESULT_VARIABLE code TIMEOUT 120)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "chromium: exit code ${code}\n${log}")
endif()
string(REGEX MATCH "<html[^>]*>" head "${dom}")
foreach(wanted "data-done=\"yes\"" "data-empty=\"\"" "data-fetched=\"\"" "data-outside=\"\"" "data-wide=\"no\"")
  string(FIND "${head}" "${wanted}" place)
  if(place EQUAL -1)
    message(SEND_ERROR "the browser found ${head}\n    wanted ${wanted}")
  endif()
endforeach()
if(head MATCHES "data-error")
  message(SEND_ERROR "a script failed: ${head}")
endif()
string(REGEX REPLACE ".*data-figures=\"([0-9]+)\".*" "\\1" n "${head}")
if(NOT n GREATER 14)
  message(SEND_ERROR "${n} figures, more than 14 were expected: ${head}")
endif()

# On paper too.
execute_process(
  COMMAND ${CHROMIUM} --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir=${out}/profile --print-to-pdf=${out}/report.pdf file://${folder}/report.html
  OUTPUT_QUIET ERROR_VARIABLE log RESULT_VARIABLE code TIMEOUT 120)
if(NOT code EQUAL 0 OR NOT EXISTS ${out}/report.pdf)
  message(SEND_ERROR "chromium prints no PDF: exit code ${code}\n${log}")
endif()

# What is folded on the screen is printed: folded or open, the sections give the same paper.
file(READ ${folder}/report.html page)
foreach(state "<details>" "<details open>")
  string(REPLACE "<section>" "${state}<summary>Folded</summary><section>" folded "${page}")
  string(REPLACE "</section>" "</section></details>" folded "${folded}")
  file(WRITE ${folder}/folded.html "${folded}")
  execute_process(
    COMMAND ${CHROMIUM} --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir=${out}/profile --print-to-pdf=${out}/folded.pdf file://${folder}/folded.html
    OUTPUT_QUIET ERROR_QUIET TIMEOUT 120)
  file(SIZE ${out}/folded.pdf size)
  list(APPEND sizes ${size})
endforeach()
list(GET sizes 0 when_folded)
list(GET sizes 1 when_open)
math(EXPR apart "${when_open} - ${when_folded}")
if(apart GREATER 1000 OR apart LESS -1000)
  message(SEND_ERROR "folded the page prints as ${when_folded} bytes, open as ${when_open}: what is folded must be printed")
endif()
file(REMOVE_RECURSE ${out})
