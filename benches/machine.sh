# For the scripts beside it: what was measured, by what, where and when, in one line.
machine() {
    commit=$(git describe --always --dirty 2>/dev/null || echo 'no commit')
    echo "vfold $("$1" --version | cut -d' ' -f2) ($commit), $(rustc --version | cut -d' ' -f1,2), $(nproc) cores of$(sed -n 's/^model name.*://p' /proc/cpuinfo | head -n 1), $(uname -n), $(date +%F), load $(cut -d' ' -f1 /proc/loadavg)."
}
