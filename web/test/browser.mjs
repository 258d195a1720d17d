// A browser: digests, tilt, switches, no message of an error: browser.mjs PAGE PLAYWRIGHT [FOLDER for pictures].
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";

const [, , page, playwright, pictures] = process.argv;
const { chromium } = createRequire(import.meta.url)(playwright);
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
let wrong = 0;
function check(name, right, told = "") {
  if (!right) wrong += 1;
  console.log(`${right ? "ok   " : "WRONG"} ${name} ${told}`);
}

async function open(options) {
  const context = await browser.newContext(options);
  const tab = await context.newPage();
  tab.setDefaultTimeout(60000);
  const errors = [];
  tab.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  tab.on("pageerror", (error) => errors.push(String(error)));
  await tab.goto(pathToFileURL(page).href);
  await tab.waitForSelector("#fluid");
  return { tab, errors, shoot: (name) => pictures && tab.screenshot({ path: `${pictures}/${name}.png`, fullPage: true }) };
}

/** Where the picture is blue: the mean of the columns, 0 to 1. */
const middle = (tab) => tab.evaluate(() => {
  const canvas = document.getElementById("fluid");
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  let [sum, count] = [0, 0];
  for (let at = 0; at < data.length; at += 4) if (data[at + 2] > 180) { sum += (at / 4) % canvas.width; count += 1; }
  return sum / count / canvas.width;
});
/** Whether something is drawn at a place, 0 to 1 from the top left. */
const drawn = (tab, u, v) => tab.evaluate(([u, v]) => {
  const canvas = document.getElementById("fluid");
  return canvas.getContext("2d").getImageData(u * canvas.width, v * canvas.height, 1, 1).data[3] > 0;
}, [u, v]);
/** How many points of the picture have the colour of a lamp that is on. */
const orange = (tab) => tab.evaluate(() => {
  const canvas = document.getElementById("fluid");
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  let count = 0;
  for (let at = 0; at < data.length; at += 4) if (data[at] > 200 && data[at + 2] < 120) count += 1;
  return count;
});
/** The uppermost of the picture's points that show fluid: its height, 0 to 1 from the bottom. */
const top = (tab) => tab.evaluate(() => {
  const canvas = document.getElementById("fluid");
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  for (let at = 0; at < data.length; at += 4) if (data[at + 2] > 180) return 1 - Math.floor(at / 4 / canvas.width) / canvas.height;
  return 0;
});
/** The first value of `measure` that `holds`, or the last one: as long as a slow machine may take. */
async function until(tab, measure, holds) {
  let found = await measure(tab);
  for (let tries = 0; tries < 300 && !holds(found); tries++) {
    await tab.waitForTimeout(100);
    found = await measure(tab);
  }
  return found;
}
const angle = async (tab) => Number(await tab.getAttribute("#dial", "aria-valuenow"));
const text = (tab, id) => tab.textContent(`#${id}`);
const verdict = (tab) => tab.waitForSelector("#verdict.same, #verdict.differs").then((found) => found.getAttribute("class"));

const desk = await open({ viewport: { width: 1200, height: 900 } });
for (const scalar of ["f32", "q16"]) {
  await desk.tab.click(`#scalar [value=${scalar}]`);
  await desk.tab.waitForFunction(() => document.getElementById("verdict").className === "");
  check(`digests of ${scalar}`, (await verdict(desk.tab)) === "same", await text(desk.tab, "here"));
}
await desk.tab.waitForTimeout(1000);
const before = await middle(desk.tab);
await desk.tab.focus("#dial");
for (let k = 0; k < 6; k++) await desk.tab.keyboard.press("ArrowRight");
const after = await until(desk.tab, middle, (found) => found > before + 0.1);
check("the fluid moves right", after > before + 0.1, `${before.toFixed(2)} -> ${after.toFixed(2)}`);
await desk.shoot("desk");
const dial = await desk.tab.locator("#dial").boundingBox();
await desk.tab.mouse.move(dial.x + 52, dial.y + 90);
await desk.tab.mouse.down();
await desk.tab.mouse.move(dial.x + 14, dial.y + 52, { steps: 4 });
await desk.tab.mouse.up();
check("the mouse turns the dial", Math.abs((await angle(desk.tab)) - 90) < 2, `${await angle(desk.tab)}°`);
const left = await until(desk.tab, middle, (found) => found < 0.4);
check("the fluid moves left", left < 0.4, left.toFixed(2));
// A poke: fluid that lies still, is pressed in its middle, and leaps. The picture is that of a fluid anew, which falls by little.
await desk.tab.focus("#dial");
await desk.tab.keyboard.press("ArrowDown");
await desk.tab.click("#again");
await desk.tab.waitForTimeout(1500);
const still = await top(desk.tab);
const pool = await desk.tab.locator("#fluid").boundingBox();
const side = Math.min(pool.width, pool.height);
const [x, y] = [pool.x + pool.width / 2, pool.y + pool.height / 2 + side * 0.1];
for (let k = 0; k < 4; k++) {
  await desk.tab.mouse.move(x, y);
  await desk.tab.mouse.down();
  await desk.tab.mouse.move(x, y - side * 0.2, { steps: 4 });
  await desk.tab.mouse.up();
}
const leapt = await until(desk.tab, top, (found) => found > still + 0.05);
check("a poke makes the fluid leap", leapt > still + 0.05, `${still.toFixed(2)} -> ${leapt.toFixed(2)}`);
// What is drawn in the corner and in the middle of the upper edge, where a heart has its notch.
for (const [shape, ...expected] of [["mask", false, false], ["box", true, true], ["disc", false, true]]) {
  await desk.tab.click(`#shape [value=${shape}]`);
  const found = [await drawn(desk.tab, 0.01, 0.01), await drawn(desk.tab, 0.5, 0.02)];
  const pressed = await desk.tab.getAttribute(`#shape [value=${shape}]`, "aria-pressed");
  check(`container ${shape}`, pressed === "true" && `${found}` === `${expected}`, `${found}`);
  await desk.tab.waitForTimeout(600);
  if (shape === "mask") await desk.shoot("heart");
}
await desk.tab.click("#view [value=lamps]");
const lit = await orange(desk.tab);
check("lamps are lit, about half of them", lit > 0.1 * 720 ** 2 && lit < 0.5 * 720 ** 2, `${lit} points`);
await desk.tab.mouse.move(200, 500);
await desk.tab.mouse.down();
await desk.tab.mouse.move(400, 300, { steps: 8 });
await desk.tab.mouse.up();
await desk.shoot("lamps");
for (const count of [58.2, 64.2, 100]) {
  for (const scalar of ["f32", "q16"]) {
    await desk.tab.click("#view [value=smooth]");
    await desk.tab.click(`#scalar [value=${scalar}]`);
    await desk.tab.evaluate((at) => {
      const slider = document.getElementById("count");
      slider.value = at;
      slider.dispatchEvent(new Event("input"));
    }, count);
    await desk.tab.waitForTimeout(2500);
    const rate = await text(desk.tab, "rate");
    check("it runs", parseInt(rate) > 0, `${await text(desk.tab, "count-told")} particles ${scalar}: ${rate}, ${await text(desk.tab, "cost")}`);
  }
}
await desk.tab.click("#tab-kernels");
const errorsOf = new Set();
for (const method of ["interpolate", "shepard", "corrected"]) {
  await desk.tab.selectOption("#method", method);
  errorsOf.add(await text(desk.tab, "errors"));
}
check("three estimates differ", errorsOf.size === 3, [...errorsOf].at(-1));
await desk.shoot("kernels");
await desk.tab.selectOption("#kernel", "viscosity");
check("viscosity has no sums", (await text(desk.tab, "errors")).includes("diverges"));
check("no error on the desk", desk.errors.length === 0, desk.errors.join("; "));

const phone = await open({ viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, isMobile: true, hasTouch: true, reducedMotion: "reduce" });
check("reduced motion begins paused", (await text(phone.tab, "run")) === "Run");
check("and says so", (await text(phone.tab, "verdict")) === "press Run");
await phone.shoot("phone");
check("no line is wider than the phone", await phone.tab.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
// The sensor, as the browser's own emulation reports it: tilted to the right, upright with a gamma that says nothing, on its left side.
const sensor = await phone.tab.context().newCDPSession(phone.tab);
await phone.tab.click("#sensor");
for (const [beta, gamma, expected] of [[0, 60, -90], [90, 80, 0], [0, -60, 90]]) {
  await sensor.send("DeviceOrientation.setDeviceOrientationOverride", { alpha: 0, beta, gamma });
  const found = await until(phone.tab, angle, (degrees) => Math.abs(degrees - expected) < 2);
  check("the sensor tilts", Math.abs(found - expected) < 2, `beta ${beta}, gamma ${gamma}: ${found}°`);
}
await phone.tab.waitForFunction(() => document.getElementById("sensor").textContent === "Tilting with the device");
await phone.tab.click("#run");
const leans = await until(phone.tab, middle, (found) => found < 0.4);
check("the fluid follows the sensor", leans < 0.4, leans.toFixed(2));
await phone.tab.click("#tab-kernels");
await phone.shoot("phone-kernels");
check("no error on the phone", phone.errors.length === 0, phone.errors.join("; "));
await browser.close();
process.exitCode = wrong ? 1 : 0;
