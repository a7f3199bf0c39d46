complete -c vextract -l files-from -d 'More photographs: a file with one name per line, - for standard input' -r -F
complete -c vextract -l scene -d 'Scene from vkernel [default: standard input]' -r
complete -c vextract -l camera -d 'Camera: built-in name, or a file (CSV, CGATS, rawtoaces JSON) [default: by the photograph\'s EXIF]' -r
complete -c vextract -l illuminant -d 'Illuminant: built-in name, daylight:CCT, sun:40deg or sun:LAT,LON,TIME, the sun of a cloudless day, or a file; repeated: a picture under each, or, of a shape under several lights, one picture with these in the order of the lights, skies aside [default: D65; of a photograph that says where and when it was taken, the sun\'s]' -r
complete -c vextract -l sky-illuminant -d 'Illuminant of the sky; sky: that of a cloudless day with the sun of --illuminant [default: that of the sun]' -r
complete -c vextract -l wavelengths-nm -d 'Wavelengths, nm' -r
complete -c vextract -l panel0 -d 'Corners of panel 0; facets of panels without corners are null' -r
complete -c vextract -l panel1 -d 'Corners of panel 1' -r
complete -c vextract -l panel -d 'Corners of panel N, counted from 0 as the scene has them; once for each' -r
complete -c vextract -l chart -d 'Corners of a colour chart\'s block of patches, to calibrate with' -r
complete -c vextract -l white-region -d 'Corners of a white card in the picture, to calibrate with' -r
complete -c vextract -l regions -d 'JSON file of corners, see below; the flags above win over it' -r -F
complete -c vextract -l margin -d 'Stay this far from the panels\' edges' -r
complete -c vextract -l refine -d 'Move the panels\' corners to the edges and the crease within PX pixels [PX: 6]' -r
complete -c vextract -l distortion -d 'Lens distortion about the picture\'s centre: seen radius r (1 + K1 r² + K2 r⁴), r in halves of the shorter side' -r
complete -c vextract -l overlay -d 'Draw panels, facets and left-out pixels (red) over the photograph; {} in the name stands for the IMAGE\'s' -r -F
complete -c vextract -l preview -d 'Write a small picture to find corners in, with share/picker.html, and nothing else; {} as above' -r -F
complete -c vextract -l transfer -d 'Curve of the stored numbers; auto: what the file says, or else sRGB for 8 bits and linear for the rest' -r
complete -c vextract -l black-level -d 'Stored number that means no light' -r
complete -c vextract -l white-level -d 'Stored number that means 1, from which on pixels are clipped' -r
complete -c vextract -l white -d 'Photograph of a white sheet, framed alike, to divide by: undoes uneven light; its mean counts as 1' -r -F
complete -c vextract -l undo -d 'Undo the white balance and the matrix with which the camera made an sRGB picture' -r
complete -c vextract -l exposure -d 'Value of a perfect white diffuser facing the sun, in its strongest channel, if known' -r
complete -c vextract -l chart-reference -d 'Reflectances of the chart\'s patches, row by row' -r
complete -c vextract -l chart-grid -d 'Patches of the chart' -r
complete -c vextract -l chart-cos -d 'Cosine of the angle between the sun and the chart\'s normal; 1: the chart faces the sun, unlike the panels' -r
complete -c vextract -l save-camera -d 'Write the camera\'s curves with their standard deviations, by the chart in the one IMAGE and the known --illuminant, and nothing else; a --camera from then on' -r -F
complete -c vextract -l white-reflectance -d 'Reflectance of the white card' -r
complete -c vextract -l white-cos -d 'Cosine of the angle between the sun and the white card\'s normal' -r
complete -c vextract -s o -l output -d 'Write here instead of standard output; the file appears when it is whole' -r -F
complete -c vextract -l resume -d 'Write here as --output does, line by line, and go on where an interrupted run of the same command stopped' -r -F
complete -c vextract -s j -l threads -d 'Threads to use [default: all cores]' -r
complete -c vextract -l progress -d 'Show on standard error how many samples are done, how fast, and the time left; auto: on a terminal, when the records go to a file' -r -f -a "auto\t'On a terminal, when the records go to a file'
always\t'Always'
never\t'Never'"
complete -c vextract -l save -d 'Also write a field of the records as an NPY array, samples stacked' -r
complete -c vextract -l generate -d 'Print the man page, a shell\'s completions, or page and JSON Schema of the records' -r -f -a "man\t'The man page'
stream\t'The man page vfold-stream(5): all fields of all records'
schema\t'JSON Schema of the records'
bash\t'Completions for bash'
zsh\t'Completions for zsh'
fish\t'Completions for fish'"
complete -c vextract -l list -d 'Print the built-in spectra of a kind, and your own in the directory VFOLD_DATA' -r -f -a "cameras\t'Camera sensitivities'
illuminants\t'Illuminants'
reflectances\t'Reflectances and sets of them'"
complete -c vextract -s q -l quiet -d 'Say nothing but errors'
complete -c vextract -s v -l verbose -d 'Say what was decided, measured and skipped'
complete -c vextract -l no-history -d 'Do not record this tool\'s arguments in the stream'
complete -c vextract -s h -l help -d 'Print help (see more with \'--help\')'
complete -c vextract -s V -l version -d 'Print version'

