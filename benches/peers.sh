# For the scripts beside it: other libraries, each in an environment of its own.

# peer NAME PACKAGE...: prints the Python that has these packages, installing them first; fails where pip cannot.
peer() {
    environment=$(realpath -m "${CARGO_TARGET_DIR:-target}")/$1
    shift
    { [ -x "$environment/bin/python" ] || python3 -m venv "$environment"; } >/dev/null 2>&1 &&
        "$environment/bin/python" -m pip install --quiet --disable-pip-version-check "$@" >/dev/null 2>&1 &&
        echo "$environment/bin/python"
}

# unseen_sets FOLDER [NAME...]: writes the sets of the package luxpy there and prints their files, or those of the names; fails where pip
# cannot install it.
unseen_sets() {
    peer luxpy numpy==2.2.6 >/dev/null && python=$(peer luxpy --no-deps luxpy==1.12.5) || return
    "$python" benches/unseen.py "$("$python" -c 'import site; print(site.getsitepackages()[0])')" "$@"
}
