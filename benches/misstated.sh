#!/usr/bin/env bash
# README's photograph with something stated wrongly, and what vestimate makes of it: benches/results/misstated.md, in a
# minute; also rendered photographs of real sheets in the sun, of SHARED (../shared). TOOLS: the folder of the tools, else they are built.
set -euo pipefail
cd "$(dirname "$0")/.."
. benches/machine.sh
[ -n "${TOOLS:-}" ] || cargo build --quiet --release --bins
bin=${TOOLS:-${CARGO_TARGET_DIR:-target}/release}
page=benches/results/misstated.md
shared=${SHARED:-../shared}
{
    echo '# Stated wrongly'
    echo
    machine "$bin/vkernel"
    echo
    echo "README's photograph, \`tests/data/photos/a_ideal_magenta_50.exr\`, an ideal fold of 50° without noise, with one thing stated wrongly. Within: per cent of"
    echo 'true values within two standard deviations. Because: the reason in the verdict.'
    echo
    echo '| stated | RMSE | CIEDE2000 | within | verdict | because |'
    echo '|---|---|---|---|---|---|'
    python3 -B benches/misstated.py "$bin" tests/data/photos
    if [ -e "$shared/real" ]; then
        echo
        echo '## Real sheets in the sun'
        echo
        echo "Rendered photographs (\`real/all_*\`, \`real/more\`), one light stated for all. Within: per cent of true values within one and two standard deviations."
        echo
        echo '| light stated | photographs | RMSE | within | good |'
        echo '|---|---|---|---|---|'
        python3 -B benches/misstated.py "$bin" "$shared" real
    fi
} | tee "$page.new"
mv "$page.new" "$page"
