// Light and dark: as the system says until the user chooses.

const kNames = ['stage', 'ink', 'object', 'pad', 'pusher', 'goal', 'faint', 'sample', 'force', 'friction', 'cone',
  'motion', 'slip', 'trace', 'gravity', 'body', 'limit', 'pressureLow', 'pressureHigh', 'shade'];

export class Theme {
  constructor(onChange) {
    this.onChange = onChange;
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => onChange());
  }

  isDark() {
    const chosen = document.documentElement.dataset.theme;
    return chosen ? chosen === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
  }

  set(theme) {
    document.documentElement.dataset.theme = theme;
    this.onChange();
  }

  toggle() {
    this.set(this.isDark() ? 'light' : 'dark');
  }

  /// The colours of the drawing, from the style sheet.
  colours() {
    const style = getComputedStyle(document.documentElement);
    return Object.fromEntries(kNames.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
  }
}
