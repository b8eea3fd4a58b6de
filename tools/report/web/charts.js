// Small charts as inline SVG.

// Text keeps its size on narrow screens.
const chartWidth = Math.max(300, Math.min(640, document.documentElement.clientWidth - 40));
const chartHeight = chartWidth < 500 ? 250 : 300;
const chartMargin = { left: 62, right: 14, top: 12, bottom: 44 };

function svgElement(name, attributes, text) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) {
    made.setAttribute(key, value);
  }
  if (text !== undefined) {
    made.textContent = text;
  }
  return made;
}

/** Round numbers from low to high, about so many. */
function ticks(low, high, about) {
  const raw = (high - low) / about;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map(n => n * power).find(s => s >= raw * 0.999);
  const all = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) {
    all.push(Number((i * step).toPrecision(12)));
  }
  return all;
}

/** An empty chart with axes; returns it and where a value lies. */
function makeChart(title, xRange, yRange, xName, yName) {
  const svg = svgElement("svg", { viewBox: `0 0 ${chartWidth} ${chartHeight}`, role: "img" });
  svg.append(svgElement("title", {}, title));
  const { left, right, top, bottom } = chartMargin;
  const x = v => left + (v - xRange[0]) / (xRange[1] - xRange[0]) * (chartWidth - left - right);
  const y = v => chartHeight - bottom - (v - yRange[0]) / (yRange[1] - yRange[0]) * (chartHeight - top - bottom);
  for (const tick of ticks(...yRange, 5)) {
    svg.append(svgElement("path", { class: "axis", d: `M${left} ${y(tick)}H${chartWidth - right}` }));
    svg.append(svgElement("text", { x: left - 8, y: y(tick) + 4, "text-anchor": "end" }, tick.toLocaleString("en-US")));
  }
  for (const tick of ticks(...xRange, chartWidth / 80)) {
    svg.append(svgElement("path", { class: "axis", d: `M${x(tick)} ${y(yRange[0])}v5` }));
    svg.append(svgElement("text", { x: x(tick), y: chartHeight - bottom + 19, "text-anchor": "middle" }, String(tick)));
  }
  svg.append(svgElement("text", { x: (left + chartWidth - right) / 2, y: chartHeight - 6, "text-anchor": "middle" }, xName));
  svg.append(svgElement("text",
    { x: 0, y: 0, "text-anchor": "middle", transform: `translate(13 ${(chartHeight - bottom + top) / 2}) rotate(-90)` }, yName));
  return { svg, x, y };
}

/** Bars of `width` from 0 on, up to the last that is not empty. */
function histogramChart(title, width, counts, xName, yName) {
  const last = counts.reduce((found, count, i) => count > 0 ? i : found, 0);
  const { svg, x, y } = makeChart(title, [0, (last + 2) * width], [0, 1.05 * Math.max(1, ...counts)], xName, yName);
  counts.forEach((count, i) => {
    if (count > 0) {
      const bar = svgElement("rect", {
        class: "bar", x: x(i * width) + 0.5, width: Math.max(1, x(width) - x(0) - 1), y: y(count), height: y(0) - y(count),
      });
      bar.append(svgElement("title", {}, `${rounded(i * width, 4)} to ${rounded((i + 1) * width, 4)}: ${grouped(count)}`));
      svg.append(bar);
    }
  });
  svg.append(svgElement("path", { class: "guide", d: `M${x(1)} ${y(0)}V${chartMargin.top}` }));
  return svg;
}

/** A curve through points, with a line across at `guide`. */
function curveChart(title, xs, ys, guide, xName, yName) {
  const finite = ys.filter(Number.isFinite);
  const low = Math.min(0, guide, ...finite), high = Math.max(guide, ...finite);
  const { svg, x, y } = makeChart(title, [0, xs[xs.length - 1]], [low < 0 ? 1.05 * low : 0, high > 0 ? 1.05 * high : 0.05], xName, yName);
  svg.append(svgElement("path", { class: "guide", d: `M${x(0)} ${y(guide)}H${chartWidth - chartMargin.right}` }));
  let path = "", pen = "M";
  ys.forEach((value, i) => {
    if (Number.isFinite(value)) {
      path += `${pen}${x(xs[i]).toFixed(1)} ${y(value).toFixed(1)}`;
      pen = "L";
    } else {
      pen = "M";
    }
  });
  svg.append(svgElement("path", { class: "curve", d: path }));
  return svg;
}

/** A bar for each name, with its value as text. */
function namedBars(title, entries, textOf) {
  const line = 26, nameWidth = 130, textWidth = 90;
  const svg = svgElement("svg", { viewBox: `0 0 ${chartWidth} ${line * entries.length + 4}`, role: "img" });
  svg.append(svgElement("title", {}, title));
  const most = Math.max(...entries.map(([, value]) => value), 1e-9);
  entries.forEach(([name, value], i) => {
    const width = Math.max(1, value / most * (chartWidth - nameWidth - textWidth));
    const middle = line * i + line / 2;
    svg.append(svgElement("text", { class: "name", x: 0, y: middle + 5 }, name));
    svg.append(svgElement("rect", { class: "bar", x: nameWidth, y: line * i + 4, width, height: line - 8, rx: 2 }));
    svg.append(svgElement("text", { x: nameWidth + width + 8, y: middle + 5 }, textOf(value)));
  });
  return svg;
}
