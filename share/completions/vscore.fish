complete -c vscore -l condition -d 'Measurement condition of ISO 13655: M2, without ultraviolet, compares what the sheet reflects; M1, under D50, also what it emits by fluorescence. Without fluorescence they are the same' -r -f -a "M1\t'All light that it sends out'
M2\t'What it reflects'"
complete -c vscore -l observer -d 'Standard observer of the colour difference, degrees' -r
complete -c vscore -l metrics -d 'Scores: rmse, ciede2000, pd (1 - gfc), gfc (goodness of fit), angle (spectral, degrees), metamerism (special index of CIE 15, by CIEDE2000) [default: rmse,ciede2000,pd, and metamerism under several illuminants]' -r -f -a "rmse\t'Root mean square error'
ciede2000\t'Colour difference under each illuminant'
pd\t'What the paper calls Pearson distance'
gfc\t'Goodness of fit coefficient'
angle\t'Spectral angle'
metamerism\t'From the first illuminant to each other one'"
complete -c vscore -l by -d 'Also summarise by the value of a field of the samples or their scenes, such as `geometry.angle_deg`' -r
complete -c vscore -l plot -d 'Draw estimates with their error bands, true spectra, the sheets\' colours, flat and folded, and the residuals of a single sheet; for more than seven samples, the distribution of scores and the ten worst; -: spectra as text on standard error, as wide as the terminal' -r -F
complete -c vscore -l report -d 'Write an HTML page with all results and the tools\' decisions, for browsers and printers; of many samples it shows the worst 24. Neither this nor --plot needs true spectra' -r -F
complete -c vscore -l overlay -d 'Picture of what was measured, for --report, as drawn by vextract --overlay; {} in the name stands for the sample\'s; repeated: pictures named after their samples' -r -F
complete -c vscore -l spectra -d 'Also write the estimates as a file of spectra: CSV with standard deviations, CGATS, IES TM-27' -r -F
complete -c vscore -s o -l output -d 'Write to FILE instead of standard output; it appears when it is complete' -r -F
complete -c vscore -l resume -d 'Like --output, but write line by line, and resume an interrupted run of the same command' -r -F
complete -c vscore -s j -l threads -d 'Threads to use, 1 to 1024 [default: all cores]' -r
complete -c vscore -l progress -d 'Show on standard error the samples done, the rate and the time left; auto: on a terminal, when the records go to a file' -r -f -a "auto\t'On a terminal, when the records go to a file'
always\t'Always'
never\t'Never'"
complete -c vscore -l save -d 'Also write a field of the records as an NPY array, samples stacked' -r
complete -c vscore -l generate -d 'Print the man page, a shell\'s completions, or the man page or JSON Schema of the records' -r -f -a "man\t'The man page'
stream\t'The man page vfold-stream(5): all fields of all records'
schema\t'JSON Schema of the records'
bash\t'Completions for bash'
zsh\t'Completions for zsh'
fish\t'Completions for fish'"
complete -c vscore -l list -d 'Print the built-in spectra of a kind, and your own in the directory VFOLD_DATA' -r -f -a "cameras\t'Camera sensitivities'
illuminants\t'Illuminants'
reflectances\t'Reflectances and sets of them'"
complete -c vscore -l percent -d 'Read files of reflectances without a stated unit as percent, or, with --percent=no, as fractions [default: as percent if a value is above 2]' -r -f -a "true\t''
false\t''"
complete -c vscore -l illuminant -d 'Illuminant of the colour difference; repeated: differences under each, and metamerism from the first to the others' -r -F -a "A\t''
D50\t''
D55\t''
D60\t''
D65\t''
D75\t''
E\t''
FL1\t''
FL2\t''
FL3\t''
FL4\t''
FL5\t''
FL6\t''
FL7\t''
FL8\t''
FL9\t''
FL10\t''
FL11\t''
FL12\t''
FL3.1\t''
FL3.2\t''
FL3.3\t''
FL3.4\t''
FL3.5\t''
FL3.6\t''
FL3.7\t''
FL3.8\t''
FL3.9\t''
FL3.10\t''
FL3.11\t''
FL3.12\t''
FL3.13\t''
FL3.14\t''
FL3.15\t''
LED-B1\t''
LED-B2\t''
LED-B3\t''
LED-B4\t''
LED-B5\t''
LED-BH1\t''
LED-RGB1\t''
LED-V1\t''
LED-V2\t''
LCD-R\t''
LCD-G\t''
LCD-B\t''"
complete -c vscore -l truth -d 'True reflectance: one for all samples, or a set in which each sample has its namesake [default: the samples\' own]' -r -F -a "cc24\t''
cc24-babelcolor\t''
cc24-iso17321\t''
munsell\t''"
complete -c vscore -l colour -d 'Add the estimate\'s XYZ, CIELAB and sRGB under the first illuminant to the records, with standard deviations'
complete -c vscore -l table -d 'Print a table instead of records'
complete -c vscore -s q -l quiet -d 'Print nothing but errors'
complete -c vscore -s v -l verbose -d 'Report what was decided, measured and skipped'
complete -c vscore -l no-history -d 'Do not record this tool\'s arguments in the stream'
complete -c vscore -s h -l help -d 'Print help (see more with \'--help\')'
complete -c vscore -s V -l version -d 'Print version'

