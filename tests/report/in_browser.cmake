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
window.requestAnimationFrame = (draw) => setTimeout(draw, 0);  // a browser without a screen may draw when it likes
window.onerror = (message) => { document.documentElement.dataset.error = message; };
window.onload = async () => {
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

  // Charts: a value under the pointer, another drawing after a drag, the first one again after a double click.
  const wait = () => new Promise(done => setTimeout(done, 60));
  const point = (e, type, x, y) => e.dispatchEvent(new PointerEvent(type, {clientX: x, clientY: y, button: 0, pointerId: 1, pointerType: "mouse", bubbles: true, cancelable: true}));
  const plots = [...document.querySelectorAll("svg.plot")].filter(e => e.querySelector("path.line"));
  let read = 0, zoomed = 0, whole = 0, wrong = [];
  for (const plot of plots) {
    const svg = plot.ownerSVGElement, line = plot.querySelector("path.line"), before = line.getAttribute("d");
    svg.scrollIntoView({block: "center"});
    const points = before.match(/[0-9.-]+ [0-9.-]+/g).map(p => p.split(" ").map(Number)), middle = points[Math.floor(points.length / 2)];
    const at = new DOMPoint(...middle).matrixTransform(svg.getScreenCTM());
    point(svg, "pointermove", at.x, at.y);
    const texts = [...svg.querySelectorAll(".values text")].map(e => e.textContent);
    if (texts.length > 1 && /[0-9]/.test(texts[1])) ++read;
    if (/NaN|undefined|Infinity|null/.test(texts.join())) wrong.push(texts.join());
    // What the pointer is told is what the axis says there: low + share of the axis.
    const [low, high, log, unit] = plot.dataset.y.split(" ").map(Number), box = plot.getAttribute("viewBox").split(" ").map(Number);
    const share = (box[1] + box[3] - middle[1]) / box[3], name = line.dataset.name;
    const expected = (log ? low * (high / low) ** share : low + share * (high - low)) / unit;
    const told = Number((texts[1] || "").replace("−", "-").replace(name, "").trim().split(/[ \u00a0]/)[0]);
    if (!(Math.abs(told - expected) <= 0.012 * Math.max(Math.abs(expected), log ? 0 : (high - low) / unit))) wrong.push(texts.join() + " for " + expected);
    const frame = size(plot);
    const left = frame.left + 0.3 * frame.width, right = frame.left + 0.7 * frame.width, high_y = frame.top + 0.5 * frame.height;
    point(svg, "pointerdown", left, high_y); point(svg, "pointermove", right, high_y); point(svg, "pointerup", right, high_y);
    if (line.getAttribute("d") !== before) ++zoomed;
    svg.dispatchEvent(new MouseEvent("dblclick", {bubbles: true}));
    if (line.getAttribute("d") === before) ++whole;
  }
  found.charts = [plots.length - read, plots.length - zoomed, plots.length - whole].join(" ") + (plots.length > 8 ? "" : " few");
  found.wrong = wrong.join("; ");

  // The picture that turns: drawn, another one after a drag, in another colour, at another frame, cut.
  const turn = document.querySelector("figure.turn"), canvas = turn && turn.querySelector("canvas");
  let pictures = "", last = "";
  const look = async () => {
    await wait();
    const data = new Uint32Array(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.buffer);
    let sum = 0;
    for (let i = 0; i < data.length; ++i) sum = (Math.imul(sum, 31) + data[i]) | 0;
    const text = new Set(data).size + "/" + sum;
    pictures += new Set(data).size > 8 && text !== last ? "another " : "the same ";
    last = text;
  };
  if (canvas) {
    turn.scrollIntoView();
    await look();
    const box = size(canvas), x = box.left + 0.5 * box.width, y = box.top + 0.5 * box.height;
    point(canvas, "pointerdown", x, y); point(canvas, "pointermove", x + 80, y + 30); point(canvas, "pointerup", x + 80, y + 30);
    await look();
    point(canvas, "pointermove", x, y);
    found.tip = turn.querySelector(".tip").textContent;
    const [color, cut] = turn.querySelectorAll("select"), slider = turn.querySelector("input[type=range]");
    color.value = "displacement"; color.onchange();
    await look();
    slider.value = slider.max; slider.oninput();
    await look();
    cut.value = "x"; cut.onchange();
    await look();
  }
  found.pictures = pictures;
  found.done = "yes";
};
</script>
</head>]==])
string(REPLACE "</head>" "${probe}" page "${page}")
file(WRITE ${folder}/probed.html "${page}")
execute_process(
  COMMAND ${CHROMIUM} --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --window-size=1200,900 --user-data-dir=${out}/profile
    --virtual-time-budget=9000 --dump-dom file://${folder}/probed.html
  OUTPUT_VARIABLE dom ERROR_VARIABLE log RESULT_VARIABLE code TIMEOUT 120)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "chromium: exit code ${code}\n${log}")
endif()
string(REGEX MATCH "<html[^>]*>" head "${dom}")
foreach(wanted "data-done=\"yes\"" "data-empty=\"\"" "data-fetched=\"\"" "data-outside=\"\"" "data-wide=\"no\"" "data-charts=\"0 0 0\"" "data-wrong=\"\"" "data-pictures=\"another another another another another \"")
  string(FIND "${head}" "${wanted}" place)
  if(place EQUAL -1)
    message(SEND_ERROR "the browser found ${head}\n    wanted ${wanted}")
  endif()
endforeach()
if(NOT head MATCHES "data-tip=\"(low|high), [0-9.]+ [kM]?Pa\"")
  message(SEND_ERROR "no stress under the pointer: ${head}")
endif()
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
