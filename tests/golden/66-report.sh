# The report of a photograph: what comes first, its tables, its file and the command that makes its records again.
oiiotool "$CARGO_MANIFEST_DIR/tests/data/photos/a_ideal_magenta_50.exr" -d uint16 --attrib DateTime '2026:06:21 14:30:05' \
    --attrib Exif:DateTimeOriginal '2026:06:21 14:30:05' -o "it's a photo.tif"
touch -d 2026-06-21T12:00:00Z "it's a photo.tif"
vkernel --angle-deg 50 -o scene.json
vextract "it's a photo.tif" -q --scene scene.json --camera canon-5d-mark-ii --illuminant D65 --overlay overlay.png |
    vestimate -q --spectra s.csv | vscore --colour --report report.html --overlay overlay.png > scores.ndjson
python3 - <<'PYTHON'
import hashlib, html, json, re
page = open("report.html").read()
sample = json.loads(open("scores.ndjson").read().splitlines()[1])
text = lambda markup: html.unescape(re.sub("<[^>]*>", " ", markup)).split()
section = page[page.index('<section class="sample"') :]
marks = {"verdict": 'class="verdict', "spectrum": "<svg", "colours": 'class="colour"', "overlay": "<img"}
print("in this order:", *sorted(marks, key=lambda mark: section.index(marks[mark])))
for caption in re.findall("<caption>(.*?)</caption>", page):
    print("table:", html.unescape(caption))
rows = {" ".join(text(head)): text(rest) for head, rest in re.findall('<th scope="row">(.*?)</th>(.*?)</tr>', page)}
for name, space in [("CIE XYZ, Y of white 100", "xyz"), ("CIELAB", "lab"), ("sRGB, 0 to 1", "srgb")]:
    shown = [float(word) for word in rows[name] if re.fullmatch(r"-?[0-9.]+", word)]
    told = [part for pair in zip(sample["colour"][space], sample["colour"][space + "_sd"]) for part in pair]
    off = max(abs(a - b) / max(1, abs(b)) for a, b in zip(shown, told))
    print(name, "as in the record" if len(shown) == 6 and off < 5e-3 else (shown, told))
print("taken", *rows["taken, by the camera's clock"])
print("written", *rows["file last written"])
print("checksum", "as of the file" if rows["SHA-256"] == [hashlib.sha256(open("it's a photo.tif", "rb").read()).hexdigest()] else rows["SHA-256"])
print("found:", *rows["corners of the panels"][:-2])
words = (word for word in text(page[page.index("<body>") :]) if re.fullmatch(r"-?\d+\.\d+", word))
print("numbers of more than four digits:", [word for word in words if len(word.lstrip("-0.").replace(".", "")) > 4])
print("dark on dark systems" if "prefers-color-scheme: dark" in page else "light alone")
open("command", "w").write(html.unescape(re.search("<pre><code>(.*?)</code>", page, re.S)[1]))
PYTHON
cat command
echo
mv report.html before.html
sh -e command 2>/dev/null | cmp - scores.ndjson && cmp before.html report.html && echo 'the same records and page again'
oiiotool --info -v overlay.png | grep 'vfold caption'
