#!/bin/bash
# The real things: shards under a Slurm of this machine's own, in a scratch folder, and under GNU
# parallel; each with a worker killed on the way, and the result equal to a single run's. As root.
. "$(dirname "$0")/lib.sh"

for need in slurmctld slurmd sbatch munged parallel; do
    PATH=$PATH:/usr/sbin command -v $need >log || skip_all "$need is not installed"
done
[ "$(id -u)" = 0 ] || skip_all 'only root can start a Slurm'
PATH=$PATH:/usr/sbin

daemons=()
# shellcheck disable=SC2317  # called by the trap
end_cluster() {
    for pid in "${daemons[@]}"; do kill "$pid" 2>/dev/null; done
    for pid in "${daemons[@]}"; do wait "$pid" 2>/dev/null; done
    if [ "$failures" -eq 0 ]; then rm -rf "$scratch"; else echo "# kept: $scratch"; fi
}
trap end_cluster EXIT

chmod 755 .
mkdir -p in/b munge state spool
cp "$root/garments/skirt.garment" "$root/garments/trousers.garment" .
for steps in 1 2 3 4 5 6 7 8 9 10 11 12; do
    "$KITSUKE" walk --preset paper --frames-per-step 30 --steps $steps -o in/walk$steps.bvh
done
cp in/walk[1-4].bvh in/b/
printf 'no motion\n' >in/bad.bvh
args=(in -g skirt.garment -g trousers.garment --no-times --detail 4 --body-detail 8 -q)
must_fail 3 "$KITSUKE" dress "${args[@]}" -o whole >log
ok 'the single run' test -f whole/summary.csv

is_whole() { # is_whole FOLDER: its shards are joined, and all is that of the single run
    "$KITSUKE" dress --merge "$1" -q && diff -r -x 'summary.*-of-*' whole "$1"
}
until_true() { # until_true COMMAND...: within a minute
    for ((i = 0; i < 600; i++)); do
        "$@" >/dev/null 2>&1 && return 0
        sleep 0.1
    done
    echo "never: $*"
    return 1
}

# Slurm: munge with its own user and key, one controller, one node
dd if=/dev/urandom of=munge/key bs=1 count=1024 2>log
chown -R munge munge && chmod 700 munge/key && chmod 755 munge
socket=$PWD/munge/socket
setpriv --reuid munge --regid munge --clear-groups munged --foreground --key-file="$PWD/munge/key" --socket="$socket" \
    --pid-file="$PWD/munge/pid" --log-file="$PWD/munge/log" --seed-file="$PWD/munge/seed" >munge.out 2>&1 &
daemons+=($!)
cat >slurm.conf <<CONF
ClusterName=kitsuke
SlurmctldHost=localhost(127.0.0.1)
AuthType=auth/munge
AuthInfo=socket=$socket
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
SlurmctldPort=26817
SlurmdPort=26818
StateSaveLocation=$PWD/state
SlurmdSpoolDir=$PWD/spool
SlurmctldPidFile=$PWD/slurmctld.pid
SlurmdPidFile=$PWD/slurmd.pid
SlurmctldLogFile=$PWD/slurmctld.log
SlurmdLogFile=$PWD/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
ReturnToService=2
SchedulerParameters=sched_interval=1,batch_sched_delay=0
NodeName=localhost NodeAddr=127.0.0.1 CPUs=4 State=UNKNOWN
PartitionName=main Nodes=localhost Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$PWD/slurm.conf
ok 'munge runs' until_true test -S "$socket"
slurmctld -D -f "$SLURM_CONF" >slurmctld.out 2>&1 &
daemons+=($!)
ok 'the controller runs' until_true scontrol ping
slurmd -D -N localhost -f "$SLURM_CONF" >slurmd.out 2>&1 &
daemons+=($!)
idle() { sinfo -h -o %T | grep -q idle; }
ok 'the node is idle' until_true idle

# As in the README; the number of the process is kept so that it can be killed.
cat >dress.sh <<JOB
#!/bin/sh
#SBATCH --array=1-4 --cpus-per-task=1 --output=$PWD/slurm-%a.log
cd $PWD
echo \$\$ >pid.\$SLURM_ARRAY_TASK_ID
exec $KITSUKE dress ${args[*]} -o slurm --resume --jobs 1 --shard "\$SLURM_ARRAY_TASK_ID/\$SLURM_ARRAY_TASK_COUNT"
JOB
kill_one() { # the second worker, once it has begun to write; and the array ends without it
    local id
    id=$(sbatch --parsable dress.sh) || return 1
    until_true sh -c 'test -s pid.2 && find slurm -name "*.obj" | grep -q .' || return 1
    kill -9 "$(cat pid.2)" || return 1
    ended() { [ -z "$(squeue -h -j "$id" 2>/dev/null)" ]; }
    until_true ended && [ ! -e slurm/summary.2-of-4.csv ]
}
ok 'an array of four shards, one of them killed' kill_one
is 'three have their summary' "$(cd slurm && echo summary.*)" 'summary.1-of-4.csv summary.3-of-4.csv summary.4-of-4.csv'
ok 'they cannot be joined yet' must_fail 3 "$KITSUKE" dress --merge slurm -q
again() { sbatch --wait dress.sh || [ $? -eq 3 ]; } # 3: the motion that is none
ok 'the same array once more' again
ok 'ends with the bytes of the single run' is_whole slurm

# GNU parallel
job="echo \$\$ >pid.{}; exec $KITSUKE dress ${args[*]} -o parallel --resume --jobs 1 --shard {}/4"
rm -f pid.*
kill_two() {
    local runner
    parallel -j 4 "$job" ::: 1 2 3 4 >parallel.log 2>&1 &
    runner=$!
    until_true sh -c 'test -s pid.3 && find parallel -name "*.obj" | grep -q .' || return 1
    kill -9 "$(cat pid.3)" || return 1
    wait $runner
    [ ! -e parallel/summary.3-of-4.csv ]
}
ok 'GNU parallel, one worker killed' kill_two
parallel -j 2 "$job" ::: 1 2 3 4 >log 2>&1
ok 'once more, and it is the single run' is_whole parallel
done_testing
