complete -c vkernel -l angle-deg -d 'Angle between the two panels, degrees, above 0 to 180 (flat) [default: that of --regions, or 45]' -r
complete -c vkernel -l panel -d 'Panel size: WIDTH along the crease, DEPTH away from it; only the ratio matters [default: that of --regions, or 1x1]' -r
complete -c vkernel -l regions -d 'Take angle and panels from the output of vextract --find, - for standard input; other files need the corners of both panels and the picture\'s size' -r -F
complete -c vkernel -l panel1-depth -d 'Depth of panel 1, in the unit of --panel, if it differs from panel 0\'s' -r
complete -c vkernel -l facets -d 'Facets per panel, over which colour is averaged: ROWS away from the crease, COLS along it' -r
complete -c vkernel -l spacing -d 'Rows of equal depth, or graded: narrow at the crease, where colour varies' -r -f -a "uniform\t'Rows of equal depth'
graded\t'Row n ends at (n/rows)² of the depth'"
complete -c vkernel -l method -d 'Method for the form factors: exact to rounding, Monte Carlo as in the paper, or eq. (2) at facet centres, which is far off at the crease; the last two are for comparison' -r -f -a "exact\t'Right to rounding'
monte-carlo\t'Estimated from samples'
midpoint\t'Eq. (2) at the facets\' centres'"
complete -c vkernel -l sampling -d 'Monte Carlo from pairs of points spread evenly over two facets (the paper\'s method; its variance is infinite where facets meet at the crease), or from rays with the cosine law [default: area]' -r -f -a "area\t'Pairs of points'
cosine\t'Rays with the cosine law'"
complete -c vkernel -l samples -d 'Samples per form factor (point pairs), or per facet row (rays), 2 or more [default: 10000]' -r
complete -c vkernel -l seed -d 'Seed of the samples [default: 0]' -r
complete -c vkernel -l mesh -d 'Mesh on which interreflections are solved: auto, as fine as needed; facets, one flat patch per facet (the paper\'s model); ROWS times COLS patches per panel; on a shape, CELLS along each side of a facet [default: auto; facets unless --method is exact]' -r
complete -c vkernel -l tolerance -d 'Relative error of facet means that --mesh auto may leave, for reflectances up to 1, 1e-12 to 0.1; on shapes and with --light 1e-6 to 0.1, for reflectances up to 0.9, relative to a tenth of the mean for dark facets [default: 1e-5, or the least that a narrow fold allows; on shapes 5e-3, or the least possible]' -r
complete -c vkernel -l tilt-deg -d 'Angle of the sun off the bisecting plane of the fold, degrees, less than half of --angle-deg; positive lights panel 0 more' -r
complete -c vkernel -l slant-deg -d 'Angle by which the sun leans along the crease, degrees, between -90 and 90' -r
complete -c vkernel -l sky -d 'Diffuse-to-direct ratio: irradiance by the sky, uniform or of --sky-type, relative to the sun\'s; on an open plane facing the sun, or, for a sky with a horizon, on an open horizontal plane. sun:40deg or sun:LAT,LON,TIME: that of a cloudless sky with the sun there; only: no sun, and a sky of irradiance 1' -r
complete -c vkernel -l id -d 'Name of the scene' -r
complete -c vkernel -l plot -d 'Draw maps of the light exchanged between facets and of the direct light on them' -r -F
complete -c vkernel -l shape -d 'Surface of triangles and flat quadrilaterals, in any unit: one facet each, in the file\'s order; corners counter-clockwise seen from the reflecting side. At most 100000, and at most a gigabyte for pairs that are near or partly hidden' -r -F
complete -c vkernel -l folds -d 'Number of creases, 1 to 1000: valleys of --angle-deg and ridges in turn, starting with a valley; there is one panel more than creases' -r
complete -c vkernel -l ridge-deg -d 'Angle between the two panels of a ridge, on its back, degrees [default: that of the valleys]' -r
complete -c vkernel -l bow-deg -l bow -d 'Angle by which each panel curves away from the other between the crease, where they meet at --angle-deg, and its end, like the pages of an open book; degrees, between -180 and 180; negative: towards the other, as in a trough' -r
complete -c vkernel -l light -d 'A light; repeat for several. X,Y,Z: the direction towards the sun; point:X,Y,Z: a small lamp there; area:X,Y,Z,WIDTHxHEIGHT: a window or large lamp centred there, facing the middle of the sheet, its width along the y axis. :E sets the irradiance on a plane facing the light (for a lamp: at the middle of the sheet), by default 1. none: the sky alone. In a fold the middle of the crease is at 0,0,0, y runs along the crease, z out of the opening, and panel 1 is at positive x; the unit is that of --panel [default: 0,0,1; for a fold as --tilt-deg and --slant-deg state]' -r
complete -c vkernel -l sky-type -d 'Type of the sky of --sky: uniform, the same in all directions; or, dark below the horizon, overcast (Moon and Spencer), clear, or a CIE standard sky by its number, 1 to 15 (12 is clear), brightest around the first sun of --light, else 0,0,1 [default: uniform]' -r
complete -c vkernel -l zenith -d 'Direction X,Y,Z to the zenith of a sky that is not uniform [default: 0,0,1]' -r
complete -c vkernel -s o -l output -d 'Write to FILE instead of standard output; it appears when it is complete' -r -F
complete -c vkernel -l resume -d 'Like --output, but write line by line, and resume an interrupted run of the same command' -r -F
complete -c vkernel -s j -l threads -d 'Threads to use, 1 to 1024 [default: all cores]' -r
complete -c vkernel -l progress -d 'Show on standard error the samples done, the rate and the time left; auto: on a terminal, when the records go to a file' -r -f -a "auto\t'On a terminal, when the records go to a file'
always\t'Always'
never\t'Never'"
complete -c vkernel -l save -d 'Also write a field of the records as an NPY array, samples stacked' -r
complete -c vkernel -l generate -d 'Print the man page, a shell\'s completions, or the man page or JSON Schema of the records' -r -f -a "man\t'The man page'
stream\t'The man page vfold-stream(5): all fields of all records'
schema\t'JSON Schema of the records'
bash\t'Completions for bash'
zsh\t'Completions for zsh'
fish\t'Completions for fish'"
complete -c vkernel -l list -d 'Print the built-in spectra of a kind, and your own in the directory VFOLD_DATA' -r -f -a "cameras\t'Camera sensitivities'
illuminants\t'Illuminants'
reflectances\t'Reflectances and sets of them'"
complete -c vkernel -l percent -d 'Read files of reflectances without a stated unit as percent, or, with --percent=no, as fractions [default: as percent if a value is above 2]' -r -f -a "true\t''
false\t''"
complete -c vkernel -l check -d 'Instead of a scene, report how well the form factors of the facets (or of the patches of --mesh) satisfy reciprocity and energy conservation; exit status 1 if one is violated'
complete -c vkernel -l two-sided -d 'The surface of --shape reflects on both sides: its backs are as many facets again'
complete -c vkernel -s q -l quiet -d 'Print nothing but errors'
complete -c vkernel -s v -l verbose -d 'Report what was decided, measured and skipped'
complete -c vkernel -l no-history -d 'Do not record this tool\'s arguments in the stream'
complete -c vkernel -s h -l help -d 'Print help (see more with \'--help\')'
complete -c vkernel -s V -l version -d 'Print version'

