# A record that cannot be used goes out with an error; the batch goes on and the exit status says so.
vkernel --facets 2x2 --no-history | vforward --reflectance cc24:red cc24:blue cc24:green --no-history -o good.ndjson
sed '3s/"facet_rgb":\[/&[0.5,0.5,0.5],/' good.ndjson > one-facet-too-many.ndjson
status=0
vestimate one-facet-too-many.ndjson --no-history -o estimates.ndjson 2> said || status=$?
cat said
echo "vestimate: exit status $status"
grep -c '"estimate"' estimates.ndjson
grep -o '"error":.*' estimates.ndjson
{ vscore estimates.ndjson --table 2> /dev/null || echo "vscore: exit status $?"; } | below RMSE=0.01 CIEDE2000=0.3 PD=0.001
