// Strips of the last minute as people live it (a simulated one is longer), and the newest spectrum.
import { by_id, tell } from "./dom.js";
import { make_plot } from "./strip.js";
import { say_number } from "./words.js";

const most_samples = 300;  // five come a second
const strips = [
  { id: "strip_torque", of: "torque_Nm", colour: "#005f9e" },
  { id: "strip_speed", of: "speed_rpm", colour: "#00734f" },
  { id: "strip_temperature", of: "temperature_C", colour: "#b34700" },
  { id: "strip_vibration", of: "vibration_g", colour: "#8c3b6f" },
];
let times_s = [];
let draw_spectrum;

export function begin_live_plots() {
  for (const strip of strips) {
    strip.values = [];
    strip.output = by_id(strip.id).querySelector("output");
    strip.draw = make_plot(by_id(strip.id).querySelector("div"), { colour: strip.colour, x: "s" });
  }
  draw_spectrum = make_plot(by_id("spectrum").querySelector("div"), { colour: "#2b333b", x: "Hz" });
}

function keep(sample) {
  const is_new_run = times_s.length && sample.t_s < times_s[times_s.length - 1];
  if (is_new_run) forget_live_plots();
  times_s.push(sample.t_s);
  times_s = times_s.slice(-most_samples);
  for (const strip of strips) strip.values = [...strip.values, sample[strip.of] ?? null].slice(-most_samples);
}

function draw() {
  for (const strip of strips) {
    strip.draw(times_s, strip.values);
    tell(strip.output, say_number(strip.values[strip.values.length - 1], 3));
  }
}

export function forget_live_plots() {
  times_s = [];
  for (const strip of strips) strip.values = [];
}

export function show_strip(sample) {
  if (typeof sample.t_s !== "number") return;
  keep(sample);
  draw();
}

export function show_strips(samples) {
  forget_live_plots();
  samples.filter((sample) => typeof sample.t_s === "number").forEach(keep);
  draw();
}

export function show_spectrum({ channel, step_Hz, levels_dB }) {
  draw_spectrum(levels_dB.map((_, i) => i * step_Hz), levels_dB);
  tell(by_id("spectrum").querySelector("output"), channel);
}

/** Until a run tells more. */
export function show_no_spectrum() {
  draw_spectrum([], []);
  tell(by_id("spectrum").querySelector("output"), "");
}
