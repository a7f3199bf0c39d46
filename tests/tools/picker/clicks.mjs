// Marks two panels and a chart in share/picker.html as a person would, on screens of three widths, and prints what the page then says, as JSON.
//   node clicks.mjs PICKER.html PREVIEW.png CORNERS.json SCREENSHOT.png
// CORNERS.json: {"width", "height" of the photograph, "panel0", "panel1", "chart"}: four [x, y] each, px of the photograph.
import { copyFileSync, readFileSync, writeFileSync } from "node:fs";
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
const value = (page, id) => page.locator(id).inputValue();
const problems = [];

async function opened(width, height, ...files) {
  const page = await browser.newPage({ viewport: { width, height } });
  page.on("pageerror", (error) => problems.push(error.message));
  page.on("request", (request) => /^(file|blob|data):/.test(request.url()) || problems.push(`asks for ${request.url()}`));
  await page.goto(`file://${resolve(page_)}`);
  await page.setInputFiles("#file", files);
  await page.waitForFunction(() => document.getElementById("width").value);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  if (wide > width) problems.push(`${wide} px wide on a screen of ${width}`);
  return page;
}

/** Places on the page of points of the photograph; the picture may be scrolled. */
const onPage = async (page, [x, y]) => {
  const box = await page.locator("#picture").boundingBox();
  return [box.x + (x / truth.width) * box.width, box.y + (y / truth.height) * box.height];
};
const click = async (page, corner) => page.mouse.click(...(await onPage(page, corner)));

/** Both panels: from the other end of the crease, and outer corners in the other order. */
async function otherOrder(page) {
  const [a, b, c, d] = truth.panel0;
  for (const corner of [b, a, c, d]) await click(page, corner);
  for (const corner of truth.panel1.slice(2)) await click(page, corner);
}

try {
  const page = await opened(1400, 900, preview);
  const fields = [await value(page, "#name"), await value(page, "#width"), await value(page, "#height")];
  const prompts = [await page.locator("#next").textContent()];
  for (const corner of truth.panel0) await click(page, corner);
  prompts.push(await page.locator("#next").textContent());
  for (const corner of truth.panel1.slice(2)) await click(page, corner); // the crease is panel 0's
  await page.fill("#angle", "50");
  await page.fill("#camera", "canon-5d-mark-ii");
  await page.fill("#light", "D65");
  const command = await value(page, "#command");
  await page.locator(".region[data-region=chart]").click();
  // the first corner is put 40 px off and dragged to its place, the second nudged there
  const [first, second, ...others] = truth.chart;
  await click(page, [first[0] + 40, first[1] + 40]);
  await page.mouse.move(...(await onPage(page, [first[0] + 40, first[1] + 40])));
  await page.mouse.down();
  await page.mouse.move(...(await onPage(page, [first[0] + 10, first[1] + 20])));
  await page.mouse.move(...(await onPage(page, first)));
  await page.mouse.up();
  await click(page, [second[0] - 12, second[1]]);
  const nudged = page.locator(".corner[data-region=chart][data-corner='1']");
  await nudged.focus();
  const before = await nudged.getAttribute("aria-label");
  await page.keyboard.press("Shift+ArrowRight");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("Alt+ArrowDown");
  const after = await nudged.getAttribute("aria-label");
  for (const corner of others) await click(page, corner);
  await page.screenshot({ path: screenshot });
  const regions = await value(page, "#json");
  const withChart = await value(page, "#command");

  // the file that it wrote, loaded on a tablet; then its corners in another order on a telephone
  writeFileSync("regions.json", regions);
  const tablet = await opened(900, 700, preview, "regions.json");
  await tablet.waitForFunction(() => document.getElementById("json").value);
  const loaded = await value(tablet, "#json");
  await tablet.screenshot({ path: screenshot.replace(".png", "-900.png") });
  const phone = await opened(390, 844, preview);
  await otherOrder(phone);
  const turned = await value(phone, "#json");
  await phone.screenshot({ path: screenshot.replace(".png", "-390.png") });

  // two pictures: what was marked in the first is there when one comes back to it
  copyFileSync(preview, "second.png");
  const two = await opened(1400, 900, preview, "second.png");
  for (const corner of [...truth.panel0, ...truth.panel1.slice(2)]) await click(two, corner);
  await two.locator("#following").click();
  await two.waitForFunction(() => document.getElementById("which").textContent === "2 of 2");
  await two.fill("#name", "second.exr");
  await otherOrder(two);
  await two.locator("#previous").click();
  await two.waitForFunction(() => document.getElementById("which").textContent === "1 of 2");
  await two.fill("#camera", "canon-5d-mark-ii");
  await two.fill("#light", "D65");
  const list = { regions: await value(two, "#json"), command: await value(two, "#command") };

  // names that mean something to a shell or look like flags, of files and as they are typed
  const odd = [];
  for (const name of ["-it's $(touch pwned) `x` \"5\" \\.png", "ends\nof\nlines.png", "=x.png", "~.png", "#1;x.png"]) {
    copyFileSync("plain.png", name);
    const page = await opened(1400, 900, `./${name}`);
    for (const corner of [...truth.panel0, ...truth.panel1.slice(2)]) await click(page, corner);
    odd.push([name, await value(page, "#command")]);
    if (name.includes("\n")) continue; // a field holds one line
    await page.fill("#name", "other.png");
    await page.fill("#name", name);
    odd.push([name, await value(page, "#command")]);
  }
  process.stdout.write(`${JSON.stringify({ fields, prompts, before, after, problems, command, withChart, regions, loaded, turned, list, odd })}\n`);
} finally {
  await browser.close();
}
