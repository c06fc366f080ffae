% The wedge's rates in Octave at given states, for the comparison with the compiled ones.
%
% octave-cli wedge_rates_check.m STATES FILE CASE...
%
% CASE is the JSON that wedge_case takes. STATES holds doubles: for each case in turn a count, and that many times a time and a state. FILE
% gets the rates, one state after the other.
1;
words = argv ();
addpath (fileparts (mfilename ("fullpath")));
file = fopen (words{1}, "r");
numbers = fread (file, Inf, "double");
fclose (file);
file = fopen (words{2}, "w");
place = 1;
for text = words(3 : end).'
  [wedge, start] = wedge_case (text{1});
  count = numbers(place);
  given = reshape (numbers(place + (1 : count * (numel (start) + 1))), [], count);
  place += 1 + numel (given);
  for one = given
    fwrite (file, wedge_rates (one(1), one(2 : end), wedge), "double");
  end
end
fclose (file);
