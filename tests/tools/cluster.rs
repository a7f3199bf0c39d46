//! `examples/cluster`: many processes and machines make the bytes of one process, also when a worker is
//! killed.
//!
//! A test whose scheduler is not installed says so and passes; `tests/run` installs them.

use crate::common::Workdir;

/// Six photographs, `photos.txt`, what one process makes of them, and a vestimate or vextract that is killed
/// the first time.
const SETUP: &str = concat!(
    "cluster='",
    env!("CARGO_MANIFEST_DIR"),
    r#"/examples/cluster'
    export LC_ALL=C
    "$cluster/photos" . 48x36 6
    find photos -name '*.tif' | sort > photos.txt
    extract() {
        vextract --files-from - --scene scene.json --regions corners.json --camera canon-5d-mark-ii \
            --illuminant D65 "$@" < photos.txt
    }
    dies_once() {
        mkdir -p bin
        printf '#!/bin/sh\nmkdir %s 2>/dev/null && kill -9 $$\nexec %s "$@"\n' \
            "$PWD/$1-died" "$(command -v $1)" > bin/$1
        chmod +x bin/$1
        PATH=$PWD/bin:$PATH
    }
    "#
);

/// Whether a program is there.
fn is_there(program: &str) -> bool {
    Workdir::new().can(&format!("command -v {program}"), "what it deals out to many machines")
}

/// Runs a script after [`SETUP`]; it must print `says` and end well.
fn assert_prints(script: &str, says: &str) {
    let run = Workdir::new().sh(&format!("{SETUP}{script}"));
    assert_eq!((run.status, run.stdout.as_str()), (0, says), "{}", run.stderr);
}

#[test]
fn gnu_parallel_on_this_machine() {
    if !is_there("parallel") {
        return;
    }
    assert_prints(
        r#"
        vextract --files-from photos.txt --scene scene.json --regions corners.json \
            --camera canon-5d-mark-ii --illuminant D65 --no-history > samples.one
        vestimate < samples.one > estimates.one
        dies_once vextract
        PART=2 "$cluster/parallel/extract"
        cmp samples.ndjson samples.one
        PART=2 "$cluster/parallel/extract" # nothing is left to do
        cmp samples.ndjson samples.one
        dies_once vestimate
        BLOCK=9k "$cluster/parallel/estimate" --joblog jobs < samples.one > estimates.ndjson
        cmp estimates.ndjson estimates.one
        ls -d *-died
        [ $(wc -l < jobs) -ge 4 ] && echo several jobs"#,
        "vestimate-died\nvextract-died\nseveral jobs\n",
    );
}

/// Two machines are two daemons on loopback, with keys and settings of their own.
#[test]
fn gnu_parallel_over_ssh() {
    if !["parallel", "/usr/sbin/sshd", "ssh"].iter().all(|program| is_there(program)) {
        return;
    }
    assert_prints(
        r#"
        vkernel --facets 3x3 | vforward --reflectance cc24 --noise-sd 1e-3 > samples.ndjson
        vestimate < samples.ndjson > estimates.one
        dies_once vestimate
        ssh-keygen -q -t ed25519 -N '' -f host_key
        ssh-keygen -q -t ed25519 -N '' -f user_key
        [ "$(id -u)" != 0 ] || mkdir -p /run/sshd
        for host in 127.0.0.1 127.0.0.2; do
            port=$((20000 + $$ % 20000))
            cat > sshd-$host <<END
ListenAddress $host:$port
HostKey $PWD/host_key
AuthorizedKeysFile $PWD/user_key.pub
PidFile $PWD/sshd-$host.pid
PermitRootLogin prohibit-password
StrictModes no
UsePAM no
MaxStartups 100
ForceCommand echo \$SSH_CONNECTION | cut -d' ' -f3 >> $PWD/hosts-used; eval "\$SSH_ORIGINAL_COMMAND"
END
            /usr/sbin/sshd -f sshd-$host -E $host.log
            echo "2/$host" >> hosts
        done
        trap 'kill $(cat sshd-*.pid)' EXIT
        options='-o StrictHostKeyChecking=no -o UserKnownHostsFile=/dev/null -o LogLevel=ERROR'
        export PARALLEL_SSH="ssh -F none -i $PWD/user_key -p $port $options"
        BLOCK=9k "$cluster/parallel/estimate" --sshloginfile hosts --env PATH \
            < samples.ndjson > estimates.ndjson
        cmp estimates.ndjson estimates.one
        ls -d *-died
        sort -u hosts-used"#,
        "vestimate-died\n127.0.0.1\n127.0.0.2\n",
    );
}

/// Slurm itself is played by a loop: it sets three variables and starts a killed task again.
#[test]
fn slurm_tasks() {
    assert_prints(
        r#"
        extract > samples.one
        vestimate - < samples.one > estimates.one
        dies_once vextract
        dies_once vestimate
        export SLURM_ARRAY_TASK_COUNT=3 SLURM_CPUS_PER_TASK=1
        for SLURM_ARRAY_TASK_ID in 1 2 3; do
            export SLURM_ARRAY_TASK_ID
            until bash "$cluster/slurm/job" 2>/dev/null; do echo queued again; done
        done
        "$cluster/merge" parts/*.estimates | cmp - estimates.one
        ls -d *-died"#,
        "queued again\nqueued again\nvestimate-died\nvextract-died\n",
    );
}

#[test]
fn snakemake_workflow() {
    if !is_there("snakemake") {
        return;
    }
    assert_prints(
        r#"
        extract --no-history | vestimate --no-history > estimates.ndjson
        python3 "$cluster/snakemake/table.py" estimates.ndjson > spectra.one
        dies_once vestimate
        workflow() { snakemake --snakefile "$cluster/snakemake/Snakefile" --cores 2 --quiet all "$@"; }
        workflow 2> said || echo stopped
        workflow --rerun-incomplete 2> said
        cmp spectra.csv spectra.one
        ls plots | wc -l
        ls -d *-died"#,
        "stopped\n6\nvestimate-died\n",
    );
}
