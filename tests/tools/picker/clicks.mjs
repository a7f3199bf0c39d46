// Marks two panels and a chart in share/picker.html as a person would, and prints what the page then says, as JSON.
//   node clicks.mjs PICKER.html PREVIEW.png CORNERS.json SCREENSHOT.png
// CORNERS.json: {"width", "height" of the photograph, "panel0", "panel1", "chart"}: four [x, y] each, px of the photograph.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { resolve } from "node:path";

const { chromium } = createRequire(`${process.env.PICKER_NODE_MODULES}/`)("playwright-core");
const [page_, preview, corners_, screenshot] = process.argv.slice(2);
const truth = JSON.parse(readFileSync(corners_));
const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync"],
});
try {
  const page = await browser.newPage({ viewport: { width: 1400, height: 900 } });
  const problems = [];
  page.on("pageerror", (error) => problems.push(error.message));
  page.on("request", (request) => /^(file|blob|data):/.test(request.url()) || problems.push(`asks for ${request.url()}`));
  await page.goto(`file://${resolve(page_)}`);
  await page.setInputFiles("#file", preview);
  await page.waitForFunction(() => document.getElementById("width").value);

  const box = await page.locator("#picture").boundingBox();
  const onPage = ([x, y]) => [box.x + (x / truth.width) * box.width, box.y + (y / truth.height) * box.height];
  const click = async (corner) => page.mouse.click(...onPage(corner));
  const prompts = [await page.locator("#next").textContent()];
  for (const corner of truth.panel0) await click(corner);
  prompts.push(await page.locator("#next").textContent());
  for (const corner of truth.panel1.slice(2)) await click(corner); // the crease is panel 0's
  await page.locator(".region[data-region=chart]").click();
  // the first corner is put 40 px off and dragged to its place, the second nudged there
  const [first, second, ...others] = truth.chart;
  await click([first[0] + 40, first[1] + 40]);
  await page.mouse.move(...onPage([first[0] + 40, first[1] + 40]));
  await page.mouse.down();
  await page.mouse.move(...onPage([first[0] + 10, first[1] + 20]));
  await page.mouse.move(...onPage(first));
  await page.mouse.up();
  await click([second[0] - 12, second[1]]);
  const nudged = page.locator(".corner[data-region=chart][data-corner='1']");
  await nudged.focus();
  const before = await nudged.getAttribute("aria-label");
  await page.keyboard.press("Shift+ArrowRight");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("Alt+ArrowDown");
  const after = await nudged.getAttribute("aria-label");
  for (const corner of others) await click(corner);
  await page.screenshot({ path: screenshot });
  const value = (id) => page.locator(id).inputValue();
  const said = { prompts, before, after, problems, command: await value("#command"), regions: await value("#json") };
  process.stdout.write(`${JSON.stringify(said)}\n`);
} finally {
  await browser.close();
}
