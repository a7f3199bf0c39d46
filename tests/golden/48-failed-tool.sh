# Behind a tool that failed, a pipeline says nothing more: its one line is that of the tool that failed; an empty file is named.
vkernel --facets 2x2 -o scene.json
all() { "$@" 2>&1 || echo "status $?"; }
all sh -c 'vextract none.exr --scene scene.json | vestimate | vscore --table'
all sh -c 'vkernel --angle-deg 500 | vforward --reflectance cc24 | vestimate --plot - | vscore --report report.html'
all sh -c 'vextract --find none.exr | vkernel --regions - | vforward --reflectance cc24'
ls
: >empty.ndjson
all vestimate empty.ndjson
all vestimate </dev/null
