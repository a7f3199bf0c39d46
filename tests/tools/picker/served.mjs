// What a person does on the page of vextract --pick: looks at the fold that was found, moves a corner, takes the white card that is
// offered, has the fold found anew, and is done.
//   node served.mjs ADDRESS SCREENSHOT.png CORNERS.json
// CORNERS.json: {"width", "height" of the photograph, "panel0", "panel1"}: four [x, y] each. Prints the page's words and regions after each step.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const { chromium } = createRequire(`${process.env.PICKER_NODE_MODULES}/`)("playwright-core");
const [address, screenshot, corners_] = process.argv.slice(2);
const truth = JSON.parse(readFileSync(corners_));
const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync"],
});
const problems = [];
try {
  const page = await browser.newPage({ viewport: { width: 1400, height: 900 } });
  page.on("pageerror", (error) => problems.push(error.message));
  page.on("request", (request) => {
    const url = request.url();
    if (!url.startsWith(address) && !/^(blob|data):/.test(url)) problems.push(`asks for ${url}`);
  });
  const words = (beginning) => page.waitForFunction(
    (beginning) => document.getElementById("next").textContent.startsWith(beginning) && document.getElementById("next").textContent, beginning);
  const regions = async () => JSON.parse((await page.locator("#json").inputValue()) || "{}");
  const onPage = async ([x, y]) => {
    const box = await page.locator("#picture").boundingBox();
    return [box.x + (x / truth.width) * box.width, box.y + (y / truth.height) * box.height];
  };
  const middle = (panel) => [0, 1].map((axis) => panel.reduce((sum, corner) => sum + corner[axis] / 4, 0));

  await page.goto(address);
  const greeting = await (await words("This fold was found")).jsonValue();
  const found = await regions();
  await page.screenshot({ path: screenshot });

  // a corner that is dragged away stays there
  const [x, y] = await onPage(found.panel0[2]);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 30, y + 20);
  await page.mouse.up();
  const dragged = await regions();

  // a white card is offered, not assumed
  const hidden = await page.locator("#suggest").isHidden();
  await page.locator(".region[data-region=white]").click();
  if (await page.locator("#suggest").isVisible()) await page.locator("#suggest").click();
  const { white } = await regions();

  await page.locator("#find").click();
  await page.mouse.click(...(await onPage(middle(truth.panel0))));
  await page.mouse.click(...(await onPage(middle(truth.panel1))));
  await words("This fold was found");
  const again = await regions();

  await page.locator("#done").click();
  const goodbye = await (await words("vextract has received the corners")).jsonValue();
  process.stdout.write(`${JSON.stringify({ greeting, found, dragged, hidden, white, again, goodbye, problems })}\n`);
} finally {
  await browser.close();
}
