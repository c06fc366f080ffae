"use strict";
(async () => {
  const unpack = async (id) => {
    const text = atob(document.getElementById(id).textContent);
    const bytes = Uint8Array.from(text, (sign) => sign.charCodeAt(0));
    const unpacked = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Response(unpacked).text();
  };
  const [data, viewer] = await Promise.all(["wedgelab-view", "wedgelab-viewer"].map(unpack));
  document.getElementById("wedgelab-view").textContent = data;
  const script = document.createElement("script");
  script.textContent = viewer;
  document.body.append(script);
})();
