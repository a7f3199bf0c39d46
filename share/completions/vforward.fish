complete -c vforward -l reflectance -d 'Reflectances: set, set:member, number, or file (CSV, CGATS, TM-27, rawtoaces)' -r
complete -c vforward -l panel-reflectance -d 'Panel P (0 or 1) has this reflectance, the other is the sheet; given for both, panel 0 is the sheet' -r
complete -c vforward -l facet-reflectance -d 'Reflectance of every facet, one sample per file: facets (panel, row, column) x wavebands, float64; one flat patch per facet, no truth in the samples' -r -F
complete -c vforward -l camera -d 'Camera: built-in name, or a file (CSV, CGATS, rawtoaces JSON)' -r
complete -c vforward -l illuminant -d 'Illuminant: built-in name, daylight:CCT, sun:40deg or sun:LAT,LON,TIME, the sun of a cloudless day, or a file; repeated: a picture under each, or, of a shape under several lights, one picture with these in the order of the lights, skies aside [default: D65; of a photograph that says where and when it was taken, the sun\'s]' -r
complete -c vforward -l sky-illuminant -d 'Illuminant of the sky; sky: that of a cloudless day with the sun of --illuminant [default: that of the sun]' -r
complete -c vforward -l wavelengths-nm -d 'Wavelengths, nm' -r
complete -c vforward -l reference-panel -d 'Panel 1 is a card of this reflectance: --panel-reflectance 1=SPEC' -r
complete -c vforward -l bounces -d 'Bounces of light that count: all, the first N (0: direct light alone), or as many as the scene\'s tolerance asks for' -r
complete -c vforward -l exposure -d 'Value of a perfect white diffuser facing the sun, in its strongest channel' -r
complete -c vforward -l noise-sd -d 'Standard deviation of noise on every facet (with --render: on every pixel of the picture only)' -r
complete -c vforward -l photon-noise -d 'Standard deviation of photon noise at value 1; it grows with the root of the signal' -r
complete -c vforward -l seed -d 'Seed of the noise' -r
complete -c vforward -l gloss -d 'Strength of the surface\'s reflection, that of a closed surface of refractive index 1.5 being 1; the camera stands at --eye' -r
complete -c vforward -l gloss-roughness -d 'Roughness of the surface: alpha of its microfacets (GGX), above 0 to 1' -r
complete -c vforward -l body-roughness-deg -d 'Roughness of the body of the sheet: the spread of the slopes of its facets (Oren and Nayar\'s sigma)' -r
complete -c vforward -l fuzz -d 'By how much the body is brighter where light grazes it, or the eye, as that of felt' -r
complete -c vforward -l render -d 'Also take a photograph of the first sheet: camera RGB as .exr or 16-bit .tif, or for the eye as .png (sRGB)' -r -F
complete -c vforward -l render-size -d 'Size of the photograph' -r
complete -c vforward -l eye -d 'Where the camera stands, in the unit of the panels, for --render and for sheets that are not perfectly matt [default: off by a few degrees from where the sun is]' -r
complete -c vforward -l look-at -d 'What it looks at [default: the middle]' -r
complete -c vforward -l up -d 'What points upwards in the photograph [default: the crease]' -r
complete -c vforward -l field-of-view-deg -d 'Angle over the photograph\'s width [default: it is cut to what it shows]' -r
complete -c vforward -l material -d 'A group of a shape\'s facets has this reflectance; repeated for several groups. All other facets are the sheet' -r
complete -c vforward -l kernel -d 'Instead of a scene: form factors, facets x facets; row i, column j is the share of the light of facet i that reaches j' -r -F
complete -c vforward -l irradiance -d 'Direct light: one number per facet, or one row per source [default: 1 everywhere]' -r -F
complete -c vforward -l areas -d 'Areas of the facets [default: those that reciprocity asks for]' -r -F
complete -c vforward -s o -l output -d 'Write here instead of standard output; the file appears when it is whole' -r -F
complete -c vforward -l resume -d 'Write here as --output does, line by line, and go on where an interrupted run of the same command stopped' -r -F
complete -c vforward -s j -l threads -d 'Threads to use [default: all cores]' -r
complete -c vforward -l progress -d 'Show on standard error how many samples are done, how fast, and the time left; auto: on a terminal, when the records go to a file' -r -f -a "auto\t'On a terminal, when the records go to a file'
always\t'Always'
never\t'Never'"
complete -c vforward -l save -d 'Also write a field of the records as an NPY array, samples stacked' -r
complete -c vforward -l generate -d 'Print the man page, a shell\'s completions, or page and JSON Schema of the records' -r -f -a "man\t'The man page'
stream\t'The man page vfold-stream(5): all fields of all records'
schema\t'JSON Schema of the records'
bash\t'Completions for bash'
zsh\t'Completions for zsh'
fish\t'Completions for fish'"
complete -c vforward -l list -d 'Print the built-in spectra of a kind, and your own in the directory VFOLD_DATA' -r -f -a "cameras\t'Camera sensitivities'
illuminants\t'Illuminants'
reflectances\t'Reflectances and sets of them'"
complete -c vforward -s q -l quiet -d 'Say nothing but errors'
complete -c vforward -s v -l verbose -d 'Say what was decided, measured and skipped'
complete -c vforward -l no-history -d 'Do not record this tool\'s arguments in the stream'
complete -c vforward -s h -l help -d 'Print help (see more with \'--help\')'
complete -c vforward -s V -l version -d 'Print version'

