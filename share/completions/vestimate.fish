complete -c vestimate -l prior -d 'What is known of reflectances beforehand: sheets (paint, cloth, plants, skin, paper, prints), spectra (set or file), smooth (the paper\'s estimator) or none [default: sheets]' -r
complete -c vestimate -l smoothness -d 'Weight of the squared second differences of the spectrum, for --prior smooth and --method park or khan; auto: what the noise allows [default: 1e-5; 1e-4 for park, 0 for khan]' -r
complete -c vestimate -l noise-sd -d 'Standard deviation of every facet; auto: what the samples say, else what no reflectance explains' -r
complete -c vestimate -l model-error -d 'Error of the model, relative to a facet\'s value [default: 3e-4 for photographs, 0 for computed facets]' -r
complete -c vestimate -l exposure -d 'Value of white facing the sun; free: fitted; sum: by sums, as in the paper [default: what the sample says, else free]' -r
complete -c vestimate -l fit -d 'What is fitted along with the spectrum, with commas between; the scene\'s values are what is expected [default: auto for photographs that an ideal fold does not explain, else none]' -r -f -a "exposure\t'Value of white facing the sun, as --exposure free'
angle\t'Angle between the panels'
tilt\t'Angle of the sun off the bisecting plane'
sky\t'Amount of skylight, and its colour unless the scene has a sky illuminant'
auto\t'All that sets a real sheet apart from an ideal one, bounded by priors'
none\t'Nothing: the scene is believed as it is told'"
complete -c vestimate -l reference-panel -d 'Panel 1 is a card of this reflectance [default: what the scene says]' -r
complete -c vestimate -l start -d 'Reflectance to set out from [default: the prior\'s mean; 0.5 for --prior smooth and none]' -r
complete -c vestimate -l plot -d 'Draw estimates, their error bands and true spectra, what the sheets look like under D65, flat and folded, and of a single sheet what the estimate leaves of its facets; -: spectra on standard error, in characters as wide as the terminal' -r -F
complete -c vestimate -l spectra -d 'Also write the estimates as a file of spectra: CSV with standard deviations, CGATS, IES TM-27' -r -F
complete -c vestimate -l trace -d 'Write the iterations of every estimate, one JSON record a line' -r -F
complete -c vestimate -l method -d 'From the bounces in a fold, or from the mean colour of a flat sheet (vkernel --angle-deg 180): Park 2007, principal components and smoothness; Khan 2013, the components that sensors and lights see' -r -f -a "interreflection\t'From the bounces of light between the panels of a fold'
park\t'Flat sheet: combination of principal components, smooth'
khan\t'Flat sheet: combination of the components that sensors and lights see'"
complete -c vestimate -l components -d 'Components that a spectrum is combined of [default: 8 for park, 9 for khan, no more than channels times lights]' -r
complete -c vestimate -l basis -d 'Spectra that have the components [default: munsell]' -r
complete -c vestimate -l reflectance -d 'Reflectances that will be photographed [default: cc24]' -r
complete -c vestimate -l camera -d 'Camera of a scene that has none [default: canon-5d-mark-ii]' -r
complete -c vestimate -l illuminant -d 'Illuminant of a scene that has none; repeated: a picture under each, or one per light as for vforward [default: D65]' -r
complete -c vestimate -l sky-illuminant -d 'Illuminant of its sky [default: that of the sun]' -r
complete -c vestimate -l material -d 'A group of a shape\'s facets has this reflectance; repeated for several groups. All other facets are the sheet' -r
complete -c vestimate -l kernel -d 'Instead of a scene: form factors, facets x facets; row i, column j is the share of the light of facet i that reaches j' -r -F
complete -c vestimate -l irradiance -d 'Direct light: one number per facet, or one row per source [default: 1 everywhere]' -r -F
complete -c vestimate -l areas -d 'Areas of the facets [default: those that reciprocity asks for]' -r -F
complete -c vestimate -s o -l output -d 'Write here instead of standard output; the file appears when it is whole' -r -F
complete -c vestimate -l resume -d 'Write here as --output does, line by line, and go on where an interrupted run of the same command stopped' -r -F
complete -c vestimate -s j -l threads -d 'Threads to use [default: all cores]' -r
complete -c vestimate -l progress -d 'Show on standard error how many samples are done, how fast, and the time left; auto: on a terminal, when the records go to a file' -r -f -a "auto\t'On a terminal, when the records go to a file'
always\t'Always'
never\t'Never'"
complete -c vestimate -l save -d 'Also write a field of the records as an NPY array, samples stacked' -r
complete -c vestimate -l generate -d 'Print the man page, a shell\'s completions, or page and JSON Schema of the records' -r -f -a "man\t'The man page'
stream\t'The man page vfold-stream(5): all fields of all records'
schema\t'JSON Schema of the records'
bash\t'Completions for bash'
zsh\t'Completions for zsh'
fish\t'Completions for fish'"
complete -c vestimate -l list -d 'Print the built-in spectra of a kind, and your own in the directory VFOLD_DATA' -r -f -a "cameras\t'Camera sensitivities'
illuminants\t'Illuminants'
reflectances\t'Reflectances and sets of them'"
complete -c vestimate -l plan -d 'Take scenes without samples and say how far off estimates will be: one record per scene, for --noise-sd [default: 1e-3]'
complete -c vestimate -s q -l quiet -d 'Say nothing but errors'
complete -c vestimate -s v -l verbose -d 'Say what was decided, measured and skipped'
complete -c vestimate -l no-history -d 'Do not record this tool\'s arguments in the stream'
complete -c vestimate -s h -l help -d 'Print help (see more with \'--help\')'
complete -c vestimate -s V -l version -d 'Print version'

