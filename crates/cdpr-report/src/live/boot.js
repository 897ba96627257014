// Starts the explorer.
(() => {
  const { robot, study, file } = JSON.parse(document.getElementById("data").textContent);
  packed.explore(document.getElementById("explorer"), { robot, study, name: file });
})();
